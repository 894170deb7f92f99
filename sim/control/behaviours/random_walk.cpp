#include "sim/control/behaviours/random_walk.h"

#include "sim/control/behaviours/walk.h"

namespace swarmsmith {

ParameterSpec rho_parameter() {
  return {.name = "rho",
          .symbol = "RHO",
          .token = "rho",
          .type = ParameterSpec::Type::Real,
          .low = 0,
          .high = 1,
          .digits = 2,
          .least = 0,
          .most = 1};
}

Command RandomWalk::act(Senses& senses, const Flavour& flavour, BehaviourMemory& memory,
                        Rng& rng) const {
  const auto draw_step = [this](double u) { return exponential_step(u, step); };
  return walk(rho, draw_step, senses, flavour, memory, rng);
}

}  // namespace swarmsmith
