#include "sim/mission/scores/objects_on.h"

namespace swarmsmith {

ObjectsOnScorer::ObjectsOnScorer(const ObjectsOn& rule, const Arena& arena)
    : counts_({rule.color}, rule.at, arena) {}

void ObjectsOnScorer::observe(const Positions& seen) {
  counts_.observe(seen.objects);
}

double ObjectsOnScorer::score() const {
  return static_cast<double>(counts_.counts().front());
}

}  // namespace swarmsmith
