#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "irace_core/files/settings.h"

namespace swarmsmith {

/// The content of scenario files; the values are those of the table of options.
struct IraceScenarioFile {
  IraceSettings settings;
  std::vector<std::string> warnings;  ///< each begins with its place
};
using IraceScenarioFileOrErrors = tl::expected<IraceScenarioFile, std::vector<Error>>;

/// The environment in which a scenario is read.
struct ScenarioSurroundings {
  /// Returns the text of an included file.
  std::function<Expected<std::string>(const std::filesystem::path&)> read;
  /// Returns the value of an environment variable; nothing if it is not set.
  std::function<std::optional<std::string>(const std::string& name)> environment_variable;
};

/// Reads a scenario (irace facts, 23.1): options, the user's own variables (whose names begin with
/// a dot), and `include.scenario("other.txt")`. Files that a scenario names in R's words, includes
/// too, are relative to the file that names them; paths in options are relative to `file`. All
/// errors are reported together, except those that follow from an earlier error; `where` is
/// file:line:column.
/// `file` must be absolute; it is not opened.
IraceScenarioFileOrErrors parse_irace_scenario(std::string_view text,
                                               const std::filesystem::path& file,
                                               const ScenarioSurroundings& surroundings);

/// Reads a scenario file, with the environment of this process.
IraceScenarioFileOrErrors read_irace_scenario(const std::filesystem::path& file);

}  // namespace swarmsmith
