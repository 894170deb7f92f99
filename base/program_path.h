#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace swarmsmith {

/// Whether this user may run the file: a program or a script, no folder.
bool may_be_run(const std::filesystem::path& file);

/// The first file of this name that may be run in the folders of `search_path`, which are separated
/// by colons as in PATH. Relative folders are left out: the current folder has no say in what is
/// run. `name` has no slash.
std::optional<std::filesystem::path> program_in(std::string_view search_path,
                                                std::string_view name);

/// A program that comes with this one: the environment's `variable` names it, else it lies beside
/// this program. It need not be there.
std::filesystem::path sibling_program(const char* variable, std::string_view name);

}  // namespace swarmsmith
