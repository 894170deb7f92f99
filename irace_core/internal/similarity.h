#pragma once

#include <cstddef>
#include <vector>

#include "irace_core/parameter_space.h"

namespace swarmsmith::irace {

/// Positions, ascending, of the configurations that are similar to some other one (irace facts, 7):
/// equal choices, the same parameters active, and numbers at most `threshold` of the width of their
/// domain apart, in the logarithm where they are sampled in it. Fixed parameters don't count.
std::vector<std::size_t> similar_configurations(
    const ParameterSpace& space, const std::vector<const Configuration*>& configurations,
    double threshold);

}  // namespace swarmsmith::irace
