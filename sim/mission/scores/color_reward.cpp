#include "sim/mission/scores/color_reward.h"

namespace swarmsmith {
namespace {

std::vector<Rgb> colors_of(const ColorReward& rule) {
  std::vector<Rgb> colors;
  for (const Reward& reward : rule.rewards)
    colors.push_back(reward.color);
  return colors;
}

}  // namespace

ColorRewardScorer::ColorRewardScorer(const ColorReward& rule, const Arena& arena)
    : rewards_(rule.rewards), counts_(colors_of(rule), rule.at, arena) {}

void ColorRewardScorer::observe(const Positions& seen) {
  counts_.observe(seen.robots);
}

double ColorRewardScorer::score() const {
  const std::vector<std::int64_t> counts = counts_.counts();
  // In the order of the rule: the order of the robots cannot change the last bit.
  double sum = 0;
  for (std::size_t i = 0; i < rewards_.size(); ++i)
    sum += static_cast<double>(counts[i]) * rewards_[i].reward;
  return sum;
}

}  // namespace swarmsmith
