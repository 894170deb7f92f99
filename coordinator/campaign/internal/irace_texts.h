#pragma once

#include <string>

#include "coordinator/campaign/irace_folder.h"
#include "irace_core/parameter_space.h"
#include "irace_core/scenario.h"

namespace swarmsmith {

/// The space as an irace parameter file (irace facts, 23.2).
std::string irace_parameters(const ParameterSpace& space, IraceVersion version);

/// The options of the race as an irace scenario file: those that differ from the defaults of either
/// version. Digits are an option of irace 3.5.
std::string irace_scenario(const Scenario& race, int digits, bool with_tests, IraceVersion version);

}  // namespace swarmsmith
