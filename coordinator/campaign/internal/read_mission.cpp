#include "coordinator/campaign/internal/read_mission.h"

#include <algorithm>
#include <cmath>

#include "base/suggestion.h"
#include "coordinator/campaign/internal/read_arena.h"
#include "coordinator/campaign/internal/read_score.h"

namespace swarmsmith {
namespace {

constexpr double kLongest_s = 86'400;
/// Enough to find a swarm that fits only now and then.
constexpr int kPlacementTrials = 20;

const std::vector<std::string> kPresets = {"aggregation", "grid_exploration", "color_selection"};

/// How the starts of training pairs are drawn.
void read_training(TableReader& instances, CampaignMission& mission) {
  auto training = instances.table("training");
  if (!training) return;
  training->choice("placement", std::vector<std::string>{"uniform"});
  const auto radius = training->number("radius", {0.01, 1000});
  if (radius) mission.mission.placement = PlaceInDisc{.centre = {}, .radius_m = *radius};
  training->finish();
}

/// [mission.instances]: what designs are tried on, and then judged on.
void read_instances(TableReader& instances, CampaignMission& mission) {
  read_training(instances, mission);
  if (auto test = instances.table("test")) {
    mission.test_count = test->integer("count", {0, 99'999}).value_or(mission.test_count);
    test->finish();
  }
  instances.finish();
}

/// The mission that the file's keys change: a built-in one, or an empty arena.
Mission read_base(TableReader& table, const std::string& name) {
  const bool built_in = std::ranges::find(kPresets, name) != kPresets.end();
  std::string preset = built_in ? name : "";
  if (const auto given = table.text("preset")) {
    preset = *given;
    if (given->find('/') != std::string::npos || given->ends_with(".toml")) {
      table.complain("preset", "a preset in a file of its own is not there yet; built in are: " +
                                   joined(kPresets));
      preset = kPresets.front();
    } else if (std::ranges::find(kPresets, *given) == kPresets.end()) {
      table.complain("preset", "there is no preset \"" + *given + "\"" +
                                   did_you_mean(*given, kPresets) +
                                   "; built in are: " + joined(kPresets));
      preset = kPresets.front();
    }
  } else if (!built_in && !table.has("score")) {
    table.complain(
        "name",
        "mission \"" + name + "\" is not built in" + did_you_mean(name, kPresets) +
            ", so it needs a `preset` or a [mission.score]; built in are: " + joined(kPresets));
  }
  if (!preset.empty()) {
    if (auto mission = built_in_mission(preset)) return std::move(*mission);
  }
  return {.name = name, .arena = dodecagon_of_the_thesis(), .shuffled = {}, .rule = RobotsOn{}};
}

/// People say seconds, the engine counts control cycles.
void read_duration(TableReader& table, Mission& mission) {
  const auto duration = table.seconds("duration", {kControlPeriod_s, kLongest_s});
  if (!duration) return;
  const double cycles = *duration / kControlPeriod_s;
  mission.cycles = static_cast<int>(std::lround(cycles));
  if (std::abs(cycles - std::round(cycles)) > 1e-6) {
    table.complain("duration", "`duration` must be a multiple of the control period, 0.1 s");
  }
}

/// Tries some placements, so that a swarm that does not fit is found before the campaign.
void check_room(TableReader& table, const Mission& mission) {
  for (int seed = 1; seed <= kPlacementTrials; ++seed) {
    const auto instance = instance_of(mission, seed);
    if (instance) continue;
    table.complain("robots", "mission \"" + mission.name + "\": " + instance.error().message);
    return;
  }
}

/// One [[mission]]; `taken` are the names of those before it.
CampaignMission read_mission(TableReader& table, const std::vector<std::string>& taken) {
  CampaignMission mission;
  const std::string name = table.text("name").value_or("");
  if (!check_name(table, name, taken)) return mission;
  mission.mission = read_base(table, name);
  mission.mission.name = name;
  read_duration(table, mission.mission);
  if (const auto robots = table.integer("robots", {1, 100})) {
    mission.mission.robots = static_cast<int>(*robots);
  }
  bool arena_fits = true;
  if (auto arena = table.table("arena")) arena_fits = read_arena(*arena, mission);
  if (auto score = table.table("score")) {
    if (auto rule = read_score(*score)) mission.mission.rule = std::move(*rule);
  }
  if (auto instances = table.table("instances")) read_instances(*instances, mission);
  table.finish();
  if (arena_fits) check_room(table, mission.mission);
  return mission;
}

}  // namespace

bool check_name(TableReader& reader, const std::string& name,
                const std::vector<std::string>& taken) {
  constexpr std::string_view kLetters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  if (!reader.has("name")) {
    reader.complain("name", reader.name() + " needs a `name`");
    return false;
  }
  if (name.empty() || name.find_first_not_of(kLetters) != std::string::npos) {
    reader.complain("name",
                    "a name consists of letters, digits, `_`, `-` and `.`, and is not "
                    "empty");
    return false;
  }
  if (std::ranges::find(taken, name) != taken.end()) {
    reader.complain("name", "two " + reader.name() + " have the name \"" + name + "\"");
    return false;
  }
  return true;
}

std::vector<CampaignMission> read_missions(TableReader& root) {
  std::vector<CampaignMission> missions;
  std::vector<std::string> names;
  for (TableReader& table : root.tables("mission")) {
    missions.push_back(read_mission(table, names));
    names.push_back(missions.back().mission.name);
  }
  if (!root.has("mission")) {
    root.complain("mission",
                  "the file has no [[mission]]; the shortest is [[mission]] with name = "
                  "\"aggregation\"");
  }
  return missions;
}

}  // namespace swarmsmith
