#pragma once

#include "sim/assessment/assessment.h"
#include "sim/assessment/internal/condition_test.h"

namespace swarmsmith::assessment {

/// The machine Exploration -> Stop, whose only transition is the condition. With beta = 1 it must
/// fire in the first tested cycle whose reading satisfies it, and in no other; with eta = 0 the
/// firing cycles must follow the geometric law of one half.
Check check_condition(const ConditionTest& test, const Flavour& flavour, const Profile& profile);

}  // namespace swarmsmith::assessment
