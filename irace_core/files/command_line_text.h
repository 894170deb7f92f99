#pragma once

#include <string>

#include "irace_core/configuration.h"
#include "irace_core/parameter_space.h"

namespace swarmsmith {

/// The configuration in the form of irace's {targetRunnerArgs}: for every active parameter its
/// switch directly followed by its value, in declaration order, separated by one blank (irace
/// facts, 18.1).
std::string command_line_text(const ParameterSpace& space, const Configuration& configuration);

/// The configuration in the form that AClib's wrappers expect: "-", the switch, a blank and the
/// value of every active parameter; numbers are written as by R's as.character (irace 3.5,
/// run_target_runner).
std::string aclib_text(const ParameterSpace& space, const Configuration& configuration);

/// One value in this form: the text of a categorical or ordinal value, or a number with at most 15
/// significant digits and never in scientific notation. `value` must not be inactive.
std::string value_text(const ParameterSpace& space, std::size_t parameter, double value);

}  // namespace swarmsmith
