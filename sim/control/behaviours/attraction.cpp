#include "sim/control/behaviours/attraction.h"

namespace swarmsmith {

Command Attraction::act(Senses& senses, const Flavour& flavour, BehaviourMemory& /*memory*/,
                        Rng& /*rng*/) const {
  const NeighbourModel& model = flavour.neighbours;
  return follow_neighbours(model.attraction_gain, used_alpha(alpha, model),
                           flavour.steering.attraction_obstacle_gain, senses, flavour);
}

}  // namespace swarmsmith
