#pragma once

#include <string_view>
#include <vector>

#include "sim/assessment/assessment.h"
#include "sim/assessment/internal/condition_test.h"

namespace swarmsmith::assessment {

/// The note of a module that uses neighbours and had none: nothing it does can show that it works.
inline constexpr std::string_view kNoneSeen = "no robot ever saw a neighbour";

/// Runs a single behaviour in all three robots. Throws std::invalid_argument when it is not a
/// behaviour.
std::vector<Check> check_behaviour(const ModuleSpec& spec, const Subject& subject);

/// Runs the machine Exploration -> Stop, whose only transition is the condition. With beta = 1 it
/// must fire in the first tested cycle whose reading satisfies it, and in no other; with eta = 0
/// the firing cycles must follow the geometric distribution with probability one half. A condition
/// without its own test must fire in some cycle of each run, never with probability 0, and always
/// with probability 1.
Check check_condition(const ConditionTest& test, const Subject& subject);

/// The rates at which the condition fires with beta = 0.3, or with eta = 5 and xi = 1 for each
/// number of neighbours. The machine is Exploration <-> Exploration, with the condition in both
/// directions: it continues after a firing, so that each run gives many trials.
std::vector<Rate> rates_of(const ConditionTest& test, const Subject& subject);

}  // namespace swarmsmith::assessment
