#include <fmt/format.h>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/json.h"
#include "base/text/whole_file.h"
#include "cli/commands/commands.h"
#include "sim/control/flavour.h"
#include "sim/files/mission_file.h"
#include "sim/mission/mission.h"
#include "sim/mission/score.h"

namespace swarmsmith::cli {
namespace {

constexpr std::string_view kTemplate =
    R"(# A campaign of Swarmsmith. Every key: docs/campaign-file.md
#   swarmsmith check campaign.toml    what it will cost
#   swarmsmith run campaign.toml      runs it; kill it at any time, the same command continues
format = 1

[campaign]
name        = "@MISSION@"
seed        = 1                # everything derives from it: same file, same answer
repetitions = 1                # designs for each mission and method
store       = "campaign.db"    # every candidate and score, one SQLite file

[[mission]]
name   = "@MISSION@"           # a built-in one: aggregation, grid_exploration, color_selection
robots   = 3
duration = "120 s"
  [mission.instances]
  test = { count = 100 }       # fresh seeds on which each winner is scored in the end

# A mission of your own needs a score, and takes an arena:
# [[mission]]
# name = "shelter"
#   [mission.arena]
#   area  = 4.91                                  # m2, a dodecagon
#   floor = "gray"
#   spots = [ { shape = "square", x = 0, y = 0.5, side = 0.5, color = "white" } ]
#   [mission.score]
#   kind  = "robots_on"                           # @SCORES@
#   color = "white"

[[method]]
name    = "@FLAVOUR@"
flavour = "@FLAVOUR@"          # @FLAVOURS@
max_states      = 4
max_transitions = 4            # out of each state
# behaviours = ["exploration", "stop", "attraction", "repulsion"]
# conditions = ["black_floor", "gray_floor", "white_floor", "neighbour_count",
#               "inverted_neighbour_count", "fixed_probability"]
# turn_clock = "cycles"        # or "seconds": what turns of exploration are measured in
#   [method.parameters]
#   exploration.tau  = { int  = [1, 100] }
#   attraction.alpha = { real = [1, 5] }

[race]
max_experiments = 10_000       # simulations for each design
# first_test = 5               # irace's options, names and defaults
# confidence = 0.95

[simulator]
profile = "rvr"                # rvr: noise on; argos3: noise off, as published in 2022

[workers]
local = "auto"                 # as many slots as cores
)";

void replace_all(std::string& text, std::string_view what, std::string_view with) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size())) {
    text.replace(at, what.size(), with);
  }
}

/// The flavours for the simulated robot.
std::vector<std::string> names_of_flavours() {
  std::vector<std::string> names;
  for (const Flavour* flavour : flavours_for(kRvrModel))
    names.push_back(flavour->name);
  return names;
}

/// A campaign file with comments that runs without changes.
std::string campaign_template(const std::string& mission, const std::string& flavour) {
  std::string text(kTemplate);
  replace_all(text, "@MISSION@", mission);
  replace_all(text, "@FLAVOUR@", flavour);
  replace_all(text, "@FLAVOURS@", fmt::format("{}", fmt::join(names_of_flavours(), ", ")));
  replace_all(text, "@SCORES@", fmt::format("{}", fmt::join(score_kinds(), ", ")));
  return text;
}

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
                Error{ErrorKind::BadInput, "already exists; name another folder", file.string()});
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

CommandRun declare_init(Options& options) {
  auto arguments = std::make_shared<InitArguments>();
  options.text("DIR", arguments->folder, "Folder of the new campaign.toml (default: this one)");
  options.choice("--mission", arguments->mission, mission_names(), "Mission to design for");
  options.choice("--flavour", arguments->flavour, names_of_flavours(), "Flavour of the modules");
  return [arguments](Output& output) { return run_init(*arguments, output); };
}

}  // namespace swarmsmith::cli
