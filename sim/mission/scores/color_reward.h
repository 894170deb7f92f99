#pragma once

#include <vector>

#include "sim/mission/scores/floor_counts.h"
#include "sim/mission/scores/score_field.h"

namespace swarmsmith {

class ColorRewardScorer;

/// Sum over the robots of the reward for the colour on which they stand (thesis eq. 6.3, table
/// 6.1); a colour without a reward counts 0. With `at` "sum", each instant on a colour is rewarded.
struct ColorReward {
  static constexpr std::string_view kKind = "color_reward";
  using Scorer = ColorRewardScorer;

  std::vector<Reward> rewards;
  When at = When::End;

  template <class Rule, class Visitor>
  static void fields(Rule& rule, Visitor& field) {
    field({.key = "rewards",
           .meaning = "reward for a robot on floor of each colour; 0 on other colours",
           .required = true},
          rule.rewards);
    field(kAtField, rule.at);
  }
  std::string unit() const { return summed_unit("reward", at); }
  friend bool operator==(const ColorReward&, const ColorReward&) = default;
};

class ColorRewardScorer {
 public:
  ColorRewardScorer(const ColorReward& rule, const Arena& arena);

  void observe(const Positions& seen);
  double score() const;

 private:
  std::vector<Reward> rewards_;
  FloorCounts counts_;  ///< counts of the robots on each colour that has a reward
};

}  // namespace swarmsmith
