#include "sim/mission/scores/most_on.h"

#include <algorithm>
#include <variant>

namespace swarmsmith {

MostOnScorer::MostOnScorer(const MostOn& rule, const Arena& arena)
    : rule_(rule), counts_floor_(arena.floor == rule.color) {
  if (counts_floor_) patches_ = arena.patches;
  // A picture is not a spot: each of its pixels has its own colour.
  for (const Patch& patch : arena.patches) {
    if (!std::holds_alternative<FloorImage>(patch.shape) && patch.color == rule.color) {
      spots_.push_back(patch);
    }
  }
}

void MostOnScorer::observe(const Positions& seen) {
  robots_ = seen.robots.size();
  last_ = 0;
  for (const Patch& spot : spots_) {
    const auto on = std::ranges::count_if(
        seen.robots, [&](const Point& robot) { return color_at(spot, robot).has_value(); });
    last_ = std::max(last_, static_cast<std::int64_t>(on));
  }
  if (counts_floor_) {
    const auto is_bare = [&](const Point& robot) {
      return std::ranges::none_of(
          patches_, [&](const Patch& patch) { return color_at(patch, robot).has_value(); });
    };
    last_ = std::max(last_, static_cast<std::int64_t>(std::ranges::count_if(seen.robots, is_bare)));
  }
  sum_ += last_;
}

double MostOnScorer::score() const {
  const auto count = static_cast<double>(rule_.at == When::End ? last_ : sum_);
  if (!rule_.share || robots_ == 0) return count;
  return count / static_cast<double>(robots_);
}

}  // namespace swarmsmith
