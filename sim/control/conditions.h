#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "sim/control/module.h"
#include "sim/control/modules.h"
#include "sim/control/reference_model.h"

namespace swarmsmith {

/// Conditions, one a transition of the machine: a file each in sim/control/conditions. A condition
/// says with which probability its transition is enabled in this cycle; which readings it accepts
/// is the flavour's data. Sources: thesis facts, section 7, and rvr-automode facts, section 6.1.

Module module_of(const Condition& condition);

/// The parameters' values, in the order of the flavour's table; a label as its enumerator's index.
std::vector<double> parameters_of(const Condition& condition);

/// The inverse of the two above. Throws std::invalid_argument when `module` is not a condition or
/// the number of parameters is another.
Condition make_condition(Module module, std::span<const double> parameters);

/// Probability with which the condition enables its transition in this cycle; 0 when the reading
/// is not the one it waits for. Asks `senses` only for what it needs.
double enabling_probability(const Condition& condition, Senses& senses, const Flavour& flavour);

/// What the condition asks for.
UsedSenses senses_used_by(const Condition& condition);

}  // namespace swarmsmith
