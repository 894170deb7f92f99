#pragma once

#include <string>

#include "irace_core/configuration.h"
#include "irace_core/parameter_space.h"

namespace swarmsmith {

/// The configuration as a target-runner gets it, irace's {targetRunnerArgs}: every active
/// parameter's switch and value without anything between them, in declaration order, joined by one
/// blank (irace facts, 18.1).
std::string command_line_text(const ParameterSpace& space, const Configuration& configuration);

/// The same as AClib's wrappers get it: "-", the switch, a blank and the value of every active
/// parameter; numbers as R's as.character writes them (irace 3.5, run_target_runner).
std::string aclib_text(const ParameterSpace& space, const Configuration& configuration);

/// One value of it: the text of a choice, or a number with 15 significant digits at most and never
/// in scientific notation. `value` must not be inactive.
std::string value_text(const ParameterSpace& space, std::size_t parameter, double value);

}  // namespace swarmsmith
