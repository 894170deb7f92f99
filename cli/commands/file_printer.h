#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "cli/commands/commands.h"

namespace swarmsmith::cli {

/// Files that the program carries, such as profiles, printed as a starting point for one's own.
struct CarriedFiles {
  std::string kind;  ///< "profile"
  std::vector<std::string> names;
  std::string_view (*built_in)(std::string_view name);  ///< empty for an unknown name
  /// All that a file of one's own says, that of its base included.
  tl::expected<std::string, std::vector<Error>> (*whole)(const std::string& word);
  std::string hint;  ///< where a written file can be named: "[simulator] profile"
};

/// `word`: a built-in name or a file; without it the names are listed. `file`: to write, or empty.
ExitCode print_carried_file(const CarriedFiles& files, const std::string& word,
                            const std::string& file, Output& output);

}  // namespace swarmsmith::cli
