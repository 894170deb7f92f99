#pragma once

#include <vector>

#include "sim/assessment/assessment.h"

namespace swarmsmith::assessment {

/// Runs a behaviour alone in all three robots. A behaviour without a test is a failed assertion.
std::vector<Check> check_behaviour(const ModuleSpec& spec, const Flavour& flavour,
                                   const Profile& profile);

}  // namespace swarmsmith::assessment
