#include "sim/control/behaviours/repulsion.h"

namespace swarmsmith {

Command Repulsion::act(Senses& senses, const Flavour& flavour, BehaviourMemory& /*memory*/,
                       Rng& /*rng*/) const {
  const NeighbourModel& model = flavour.neighbours;
  const double used = used_alpha(alpha, model);
  const double weight = model.repulsion_power == 2 ? used * used : used;
  return follow_neighbours(model.repulsion_gain, -weight, flavour.steering.obstacle_gain, senses,
                           flavour);
}

}  // namespace swarmsmith
