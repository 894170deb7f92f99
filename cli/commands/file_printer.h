#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "cli/commands/commands.h"

namespace swarmsmith::cli {

/// Files built into the program, such as profiles, which users can print as a starting point for
/// their own files.
struct CarriedFiles {
  std::string kind;  ///< "profile"
  std::vector<std::string> names;
  std::string_view (*built_in)(std::string_view name);  ///< empty for an unknown name
  /// The full contents of a user's file, including the contents of its base.
  tl::expected<std::string, std::vector<Error>> (*whole)(const std::string& word);
  std::string hint;  ///< the key where the file can be named: "[simulator] profile"
};

/// `word`: a built-in name or a file; if it is empty, the names are listed. `file`: the file to
/// write, or empty.
ExitCode print_carried_file(const CarriedFiles& files, const std::string& word,
                            const std::string& file, Output& output);

}  // namespace swarmsmith::cli
