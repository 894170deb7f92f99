#include <filesystem>
#include <memory>

#include "base/text/json.h"
#include "base/text/whole_file.h"
#include "cli/commands/campaign_template.h"
#include "cli/commands/commands.h"
#include "sim/control/flavour.h"
#include "sim/mission/mission.h"

namespace swarmsmith::cli {
namespace {

struct InitArguments {
  std::string folder = ".";
  std::string mission = "aggregation";
  std::string flavour = "watermelon";
};

ExitCode run_init(const InitArguments& arguments, Output& output) {
  const auto file = std::filesystem::path(arguments.folder) / "campaign.toml";
  std::error_code trouble;
  std::filesystem::create_directories(arguments.folder, trouble);
  if (std::error_code none; std::filesystem::exists(file, none)) {
    return fail(output, ExitCode::Usage,
                Error{ErrorKind::BadInput, "is there already; name another folder", file.string()});
  }
  const std::string text = campaign_template(arguments.mission, arguments.flavour);
  if (auto written = write_whole_file(file.string(), text); !written) {
    return fail(output, ExitCode::Failed, written.error());
  }
  if (output.json) {
    output.out << JsonObject().add("file", file.string()).text() << "\n";
  } else {
    output.out << file.string() << "\n";
    print_note(output, "`swarmsmith check " + file.string() + "` shows the plan, `swarmsmith run " +
                           file.string() + "` runs it.");
  }
  return ExitCode::Done;
}

}  // namespace

Run declare_init(Options& options) {
  auto arguments = std::make_shared<InitArguments>();
  options.text("DIR", arguments->folder, "Folder of the new campaign.toml (default: this one)");
  options.choice("--mission", arguments->mission,
                 {"aggregation", "grid_exploration", "color_selection"}, "Mission to design for");
  options.choice("--flavour", arguments->flavour, {"watermelon", "watermelon-argos3", "chocolate"},
                 "Flavour of the modules");
  return [arguments](Output& output) { return run_init(*arguments, output); };
}

}  // namespace swarmsmith::cli
