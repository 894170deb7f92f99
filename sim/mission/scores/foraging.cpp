#include "sim/mission/scores/foraging.h"

#include <utility>

namespace swarmsmith {

std::optional<ScoreFault> Foraging::fault() const {
  if (nest != source) return std::nullopt;
  return ScoreFault{"source", "is also the nest's colour; choose different colours"};
}

ForagingScorer::ForagingScorer(const Foraging& rule, Arena arena)
    : rule_(rule), arena_(std::move(arena)) {}

void ForagingScorer::observe(const Positions& seen) {
  if (carries_.size() < seen.robots.size()) carries_.resize(seen.robots.size());
  for (std::size_t i = 0; i < seen.robots.size(); ++i) {
    // `fault` refuses equal colours, so that an instant either takes or leaves an item.
    const Rgb floor = floor_at(arena_, seen.robots[i]);
    if (floor == rule_.source) carries_[i] = 1;
    if (floor == rule_.nest && carries_[i] != 0) {
      carries_[i] = 0;
      ++items_;
    }
  }
}

double ForagingScorer::score() const {
  return static_cast<double>(items_);
}

}  // namespace swarmsmith
