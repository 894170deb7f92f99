#pragma once

#include "sim/control/controller.h"
#include "sim/control/flavour.h"

namespace swarmsmith {

/// What a controller may ask for in some cycle or other: what a robot must have to run it, and what
/// must travel if it runs elsewhere. It never asks for anything else but the time. States to which
/// no transition leads ask for nothing.
UsedSenses senses_used_by(const Controller& controller, const Flavour& flavour);

}  // namespace swarmsmith
