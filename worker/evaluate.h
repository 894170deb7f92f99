#pragma once

#include "worker/evaluator.h"
#include "worker/target_evaluator.h"

namespace swarmsmith {

/// Makes evaluators for a scenario: they run its programs, if these are allowed, or the simulator.
/// When another scenario comes, running programs of the previous one are killed. Errors of the
/// factory: bytes that are not a scenario, and the errors of make_simulation_evaluator and
/// make_target_evaluator.
EvaluatorFactory make_evaluators(AllowedPrograms allowed = {});

}  // namespace swarmsmith
