#pragma once

#include <string>
#include <vector>

#include "sim/control/behaviours.h"
#include "sim/control/conditions.h"
#include "sim/control/flavour.h"

namespace swarmsmith {

/// The label of a state or a condition: the module's name, broken into lines that are no wider than
/// its parameters, and then the parameters on one line.
struct ModuleLabel {
  std::vector<std::string> name;
  std::vector<std::string> parameters;  ///< lines: "ξ = 10, η = 19.66"; may be empty
};

/// The same label with one word per line and one parameter per line.
ModuleLabel narrowed(const ModuleLabel& label);

/// Throws std::invalid_argument if the flavour does not have the module.
ModuleLabel label_of(const Behaviour& behaviour, const Flavour& flavour);
ModuleLabel label_of(const Condition& condition, const Flavour& flavour);

}  // namespace swarmsmith
