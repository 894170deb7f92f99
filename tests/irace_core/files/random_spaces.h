#pragma once

#include "base/rng.h"
#include "irace_core/parameter_space.h"

namespace swarmsmith::testing {

/// A random valid space with all that a parameter file can hold: every type, odd switches and
/// values, conditions, dependent domains, forbidden clauses, digits.
ParameterSpace random_space(Rng& rng);

/// A configuration of it whose active parameters have values of their domains. Nothing when a
/// computed domain is empty.
std::optional<Configuration> random_configuration(const ParameterSpace& space, Rng& rng);

}  // namespace swarmsmith::testing
