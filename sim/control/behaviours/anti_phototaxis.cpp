#include "sim/control/behaviours/anti_phototaxis.h"

namespace swarmsmith {

Command AntiPhototaxis::act(Senses& senses, const Flavour& flavour, BehaviourMemory& /*memory*/,
                            Rng& /*rng*/) const {
  return follow_light(-1, senses, flavour);
}

}  // namespace swarmsmith
