#pragma once

#include <vector>

#include "sim/assessment/assessment.h"
#include "sim/assessment/internal/condition_test.h"

namespace swarmsmith::assessment {

/// How often the condition fires with beta = 0.3, or with eta = 5 and xi = 1 for each number of
/// neighbours. The machine is Exploration <-> Exploration, with the condition both ways: it goes on
/// after a firing, so that each run gives many trials.
std::vector<Rate> rates_of(const ConditionTest& test, const Flavour& flavour,
                           const Profile& profile);

}  // namespace swarmsmith::assessment
