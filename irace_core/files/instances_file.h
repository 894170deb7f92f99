#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// The instances of a list, one per line (irace facts, 23.3): comments, empty lines and blanks
/// before an instance are dropped; the rest of the line is the instance, including blanks at its
/// end.
std::vector<std::string> parse_instances(std::string_view text);

/// The instances in a file. If `folder` is not empty, "folder/" is put before each one. A file that
/// cannot be read or has no instances is an error.
Expected<std::vector<std::string>> read_instances_file(const std::filesystem::path& file,
                                                       const std::filesystem::path& folder);

/// The absolute paths of all files in a folder and its subfolders, without hidden ones, sorted byte
/// by byte: irace does this without a list. A folder without files is an error.
Expected<std::vector<std::string>> list_instances(const std::filesystem::path& folder);

/// A list from which the same instances are read back. An instance that a list cannot express (an
/// empty one, or one with `#`, a line end, or a blank at its beginning) is an error.
Expected<std::string> print_instances(std::span<const std::string> instances);

}  // namespace swarmsmith
