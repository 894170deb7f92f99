#include "sim/control/behaviours/phototaxis.h"

namespace swarmsmith {

Command Phototaxis::act(Senses& senses, const Flavour& flavour, BehaviourMemory& /*memory*/,
                        Rng& /*rng*/) const {
  return follow_light(1, senses, flavour);
}

}  // namespace swarmsmith
