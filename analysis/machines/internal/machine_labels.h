#pragma once

#include <string>
#include <vector>

#include "sim/control/behaviours.h"
#include "sim/control/conditions.h"
#include "sim/control/flavour.h"

namespace swarmsmith {

/// What stands in a state or a condition: the module's name, on as many lines as it takes to be no
/// wider than its parameters, then the parameters on one line.
struct ModuleLabel {
  std::vector<std::string> name;
  std::vector<std::string> parameters;  ///< lines: "ξ = 10, η = 19.66"; empty without
};

/// The same with a word a line, and a parameter a line.
ModuleLabel narrowed(const ModuleLabel& label);

/// Throws std::invalid_argument when the flavour has no such module.
ModuleLabel label_of(const Behaviour& behaviour, const Flavour& flavour);
ModuleLabel label_of(const Condition& condition, const Flavour& flavour);

}  // namespace swarmsmith
