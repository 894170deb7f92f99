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

/// What scenario files say; values are those of the table of options.
struct IraceScenarioFile {
  IraceSettings settings;
  std::vector<std::string> warnings;  ///< each begins with its place
};
using IraceScenarioFileOrErrors = tl::expected<IraceScenarioFile, std::vector<Error>>;

/// What reading a scenario needs of the world around it.
struct ScenarioSurroundings {
  /// The text of an included file.
  std::function<Expected<std::string>(const std::filesystem::path&)> read;
  /// Nothing for an environment variable that is not set.
  std::function<std::optional<std::string>(const std::string& name)> environment_variable;
  /// Where the process is (getwd); empty: where the scenario is.
  std::filesystem::path folder{};
};

/// Reads a scenario (irace facts, 23.1): options and own variables (whose names begin with a dot),
/// `include.scenario("other.txt")` (relative to `file`, as all paths). Everything wrong is reported
/// together, as far as it does not follow from an error before; `where` is file:line:column.
/// `file`, absolute, is not read.
IraceScenarioFileOrErrors parse_irace_scenario(std::string_view text,
                                               const std::filesystem::path& file,
                                               const ScenarioSurroundings& surroundings);

/// The same for a file, with this process's environment.
IraceScenarioFileOrErrors read_irace_scenario(const std::filesystem::path& file);

}  // namespace swarmsmith
