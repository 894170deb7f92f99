#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace swarmsmith {

/// Whether this user may run the file, a program or a script, but not a folder.
bool may_be_run(const std::filesystem::path& file);

/// The first executable file with this name in the folders of `search_path`, which are separated by
/// colons as in PATH. Relative folders are skipped, so that the current folder does not decide
/// which program is run. `name` has no slash.
std::optional<std::filesystem::path> program_in(std::string_view search_path,
                                                std::string_view name);

/// The path of this program. In an archive of packaging/bundle, where /proc/self/exe is the loader,
/// this is the launcher with the program's name.
std::filesystem::path own_program();
/// A path that starts this program again, in the same version even if another one has been
/// installed since.
std::filesystem::path same_program();

/// The path of a program that comes with this one: the value of the environment's `variable`, else
/// the path beside this program. It need not exist.
std::filesystem::path sibling_program(const char* variable, std::string_view name);

}  // namespace swarmsmith
