#include "sim/control/behaviours/levy_walk.h"

#include "sim/control/behaviours/walk.h"

namespace swarmsmith {

Command LevyWalk::act(Senses& senses, const Flavour& flavour, BehaviourMemory& memory,
                      Rng& rng) const {
  const auto draw_step = [this](double u) { return power_law_step(u, mu); };
  return walk(rho, draw_step, senses, flavour, memory, rng);
}

}  // namespace swarmsmith
