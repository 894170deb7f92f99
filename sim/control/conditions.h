#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "sim/control/module.h"
#include "sim/control/modules.h"
#include "sim/control/reference_model.h"

namespace swarmsmith {

/// Conditions; each transition of a machine has one. Each is defined in its own file in
/// sim/control/conditions. A condition gives the probability with which its transition is enabled
/// in the current cycle; the flavour defines which readings satisfy it. Sources: thesis facts,
/// section 7, and rvr-automode facts, section 6.1.

Module module_of(const Condition& condition);

/// The values of the parameters, in the order of the flavour's table; a label is given by the index
/// of its enumerator.
std::vector<double> parameters_of(const Condition& condition);

/// The inverse of the two functions above. Throws std::invalid_argument when `module` is not a
/// condition or takes a different number of parameters.
Condition make_condition(Module module, std::span<const double> parameters);

/// Probability with which the condition enables its transition in this cycle; 0 when the readings
/// do not satisfy it. It requests from `senses` only the readings that it needs.
double enabling_probability(const Condition& condition, Senses& senses, const Flavour& flavour);

/// The readings that the condition requests.
UsedSenses senses_used_by(const Condition& condition);

}  // namespace swarmsmith
