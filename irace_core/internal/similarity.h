#pragma once

#include <cstddef>
#include <vector>

#include "irace_core/parameter_space.h"

namespace swarmsmith::irace {

/// Positions, ascending, of the configurations that are similar to some other configuration (irace
/// facts, 7): they have equal categorical and ordinal values and the same active parameters, and
/// their numbers differ by at most `threshold` times the width of the domain, on a logarithmic
/// scale for logarithmic parameters. Fixed parameters do not count.
std::vector<std::size_t> similar_configurations(
    const ParameterSpace& space, const std::vector<const Configuration*>& configurations,
    double threshold);

}  // namespace swarmsmith::irace
