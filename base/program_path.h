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

/// Where this program lies. In an archive of packaging/bundle, where /proc/self/exe is the loader,
/// that is the launcher of its name.
std::filesystem::path own_program();
/// What starts this program once more, and the same version whatever was installed since.
std::filesystem::path same_program();

/// A program that comes with this one: the environment's `variable` names it, else it lies beside
/// this program. It need not be there.
std::filesystem::path sibling_program(const char* variable, std::string_view name);

}  // namespace swarmsmith
