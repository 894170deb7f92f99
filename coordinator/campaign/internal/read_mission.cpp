#include "coordinator/campaign/internal/read_mission.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/suggestion.h"
#include "coordinator/campaign/internal/color_text.h"
#include "coordinator/campaign/internal/read_arena.h"

namespace swarmsmith {
namespace {

constexpr double kLargest = std::numeric_limits<double>::max();
constexpr double kLongest_s = 86'400;
/// Enough to find a swarm that fits only now and then.
constexpr int kPlacementTrials = 20;

const std::vector<std::string> kPresets = {"aggregation", "grid_exploration", "color_selection"};

/// Scores that look once, at the end, take `at` and `maximize` for people coming from the examples
/// of the literature; both have one value.
void read_fixed_keys(TableReader& score) {
  score.choice("at", std::vector<std::string>{"end"});
  if (score.boolean("maximize") == false) {
    score.complain("maximize",
                   "scores are always maximised; give what is unwanted a negative "
                   "reward instead of `maximize = false`");
  }
}

/// Thesis eq. 6.1.
RobotsOn read_robots_on(TableReader& score) {
  read_fixed_keys(score);
  return {.color = read_color(score, "color").value_or(Rgb{})};
}

/// Thesis eq. 6.2.
Coverage read_coverage(TableReader& score) {
  if (score.boolean("maximize") == false) score.complain("maximize", "scores are always maximised");
  Coverage coverage;
  if (const auto tiles = score.integer("tiles", {1, 1000})) {
    coverage.tiles = static_cast<int>(*tiles);
  }
  coverage.side_m = score.number("side", {0.01, 1000}).value_or(coverage.side_m);
  return coverage;
}

/// Thesis eq. 6.3.
ColorReward read_color_reward(TableReader& score) {
  read_fixed_keys(score);
  ColorReward rule;
  auto rewards = score.table("rewards");
  if (!rewards) {
    if (!score.has("rewards")) {
      score.complain("rewards",
                     "the score color_reward needs `rewards`, such as { red = 1, "
                     "yellow = 2 }");
    }
    return rule;
  }
  for (const auto& [name, color] : read_color_keys(*rewards)) {
    const auto reward = rewards->number(name, {-kLargest, kLargest});
    rule.rewards.push_back({color, reward.value_or(0)});
  }
  if (rule.rewards.empty()) score.complain("rewards", "`rewards` names no colour");
  return rule;
}

/// [mission.score] replaces the preset's.
void read_score(TableReader& score, Mission& mission) {
  static const std::vector<std::string> kKinds = {"robots_on", "coverage", "color_reward"};
  static const std::vector<std::string> kNotYet = {"external"};
  const auto kind = score.choice("kind", kKinds, kNotYet);
  if (!kind) {
    if (!score.has("kind")) {
      score.complain("kind", score.name() + " needs a `kind`: " + joined(kKinds));
    }
    return;
  }
  if (*kind == "robots_on") mission.rule = read_robots_on(score);
  if (*kind == "coverage") mission.rule = read_coverage(score);
  if (*kind == "color_reward") mission.rule = read_color_reward(score);
  score.finish();
}

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
  if (auto score = table.table("score")) read_score(*score, mission.mission);
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
