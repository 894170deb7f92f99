#include "base/text/json.h"
#include "cli/arguments/program_name.h"
#include "cli/commands/commands.h"
#include "sim/engine/simulate.h"

namespace swarmsmith::cli {

std::string program_name() {
  return "swarmsmith " SWARMSMITH_VERSION;
}

CommandRun declare_version(Options&) {
  return [](Output& output) {
    constexpr std::string_view kVersion = SWARMSMITH_VERSION;
    constexpr std::string_view kBuild = SWARMSMITH_BUILD;
    if (output.json) {
      output.out << JsonObject()
                        .add("name", "swarmsmith")
                        .add("version", kVersion)
                        .add("engine", kEngineVersion)
                        .add("campaign_format", 1)
                        .add("events", 1)
                        .add("build", kBuild)
                        .add("compiler", __VERSION__)
                        .text()
                 << "\n";
    } else {
      output.out << "swarmsmith " << kVersion << " (engine " << kEngineVersion << ", " << kBuild
                 << ", compiler " << __VERSION__ << ")\n";
    }
    return ExitCode::Done;
  };
}

}  // namespace swarmsmith::cli
