#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// The instances of a list, one a line: comments and blanks before an instance are dropped, empty
/// lines too; the rest of the line is the instance, blanks at its end included (irace facts, 23.3).
std::vector<std::string> parse_instances(std::string_view text);

/// The lines of a file. With a folder, each one has "folder/" put before it. A file that cannot be
/// read or names none is an error.
Expected<std::vector<std::string>> read_instances_file(const std::filesystem::path& file,
                                                       const std::filesystem::path& folder);

/// The absolute paths of all files in a folder and the folders in it, hidden ones left out, sorted
/// byte by byte: irace without a list. A folder without files is an error.
Expected<std::vector<std::string>> list_instances(const std::filesystem::path& folder);

/// A list that reads back to the same. What no list can say (an empty instance, one with `#`, with
/// a line's end or a blank at its beginning) is an error.
Expected<std::string> print_instances(std::span<const std::string> instances);

}  // namespace swarmsmith
