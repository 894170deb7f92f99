#pragma once

#include <string>
#include <string_view>

#include "sim/control/flavour.h"

namespace swarmsmith {

/// A parameter of machines as people read it: "behaviour 0" of S0, "exploration tau 0" of RWM0,
/// "black floor beta 0.1" or, where modules share it, "beta 0.1" of P0x1: state 0, its edge 1. What
/// is none of them stays as it is.
std::string words_of_parameter(std::string_view name, const Flavour& flavour);

}  // namespace swarmsmith
