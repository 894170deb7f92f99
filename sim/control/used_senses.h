#pragma once

#include "sim/control/controller.h"
#include "sim/control/flavour.h"

namespace swarmsmith {

/// The readings that a controller may request in any cycle: the sensors that a robot must have to
/// run it, and the readings that must be sent if it runs elsewhere. Apart from the time it never
/// requests others. Unreachable states do not count.
UsedSenses senses_used_by(const Controller& controller, const Flavour& flavour);

}  // namespace swarmsmith
