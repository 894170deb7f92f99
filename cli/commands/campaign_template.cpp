#include "cli/commands/campaign_template.h"

#include <string_view>

namespace swarmsmith::cli {
namespace {

constexpr std::string_view kTemplate =
    R"(# A campaign of Swarmsmith. Every key: docs/campaign-file.md
#   swarmsmith check campaign.toml    what it will cost
#   swarmsmith run campaign.toml      runs it; kill it at any time, the same command goes on
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
#   kind  = "robots_on"                           # robots_on, coverage, color_reward
#   color = "white"

[[method]]
name    = "@FLAVOUR@"
flavour = "@FLAVOUR@"          # watermelon, watermelon-argos3, chocolate
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

}  // namespace

std::string campaign_template(const std::string& mission, const std::string& flavour) {
  std::string text(kTemplate);
  replace_all(text, "@MISSION@", mission);
  replace_all(text, "@FLAVOUR@", flavour);
  return text;
}

}  // namespace swarmsmith::cli
