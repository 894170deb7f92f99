#include "cli/arguments/program_name.h"
#include "cli/commands/commands.h"
#include "sim/engine/simulate.h"

namespace swarmsmith::cli {

std::string program_name() {
  return "swarmsmith " SWARMSMITH_VERSION " (engine " + std::to_string(kEngineVersion) + ")";
}

Run declare_version(Options&) {
  return [](Output& output) {
    constexpr std::string_view kVersion = SWARMSMITH_VERSION;
    constexpr std::string_view kBuild = SWARMSMITH_BUILD;
    const std::string engine = std::to_string(kEngineVersion);
    if (output.json) {
      output.out << "{\"name\":\"swarmsmith\",\"version\":" << json_text(kVersion)
                 << ",\"engine\":" << engine << ",\"campaign_format\":1,\"events\":1"
                 << ",\"build\":" << json_text(kBuild) << ",\"compiler\":" << json_text(__VERSION__)
                 << "}\n";
    } else {
      output.out << "swarmsmith " << kVersion << " (engine " << engine << ", " << kBuild
                 << ", compiler " << __VERSION__ << ")\n";
    }
    return ExitCode::Done;
  };
}

}  // namespace swarmsmith::cli
