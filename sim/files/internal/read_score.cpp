#include "sim/files/internal/read_score.h"

#include <limits>

#include "base/suggestion.h"
#include "sim/files/internal/read_color.h"

namespace swarmsmith {
namespace {

constexpr double kLargest = std::numeric_limits<double>::max();

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

}  // namespace

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

}  // namespace swarmsmith
