#include "sim/mission/scores/robots_on.h"

namespace swarmsmith {

RobotsOnScorer::RobotsOnScorer(const RobotsOn& rule, const Arena& arena)
    : counts_({rule.color}, rule.at, arena) {}

void RobotsOnScorer::observe(const Positions& seen) {
  counts_.observe(seen.robots);
}

double RobotsOnScorer::score() const {
  return static_cast<double>(counts_.counts().front());
}

}  // namespace swarmsmith
