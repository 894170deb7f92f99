#pragma once

#include <string>
#include <string_view>

#include "sim/control/flavour.h"

namespace swarmsmith {

/// A machine's parameter in words: "behaviour 0" for S0, "exploration tau 0" for RWM0, "black floor
/// beta 0.1" or, if several modules share it, "beta 0.1" for P0x1: state 0, its edge 1. Other names
/// are returned without changes.
std::string words_of_parameter(std::string_view name, const Flavour& flavour);

}  // namespace swarmsmith
