#pragma once

#include "worker/evaluator.h"
#include "worker/target_evaluator.h"

namespace swarmsmith {

/// Evaluators for whatever a scenario asks for: its programs, as far as they are allowed, or the
/// simulator. Programs of one scenario that still run when another one comes are ended. The
/// factory's errors: bytes that are not a scenario, and those of the makers.
EvaluatorFactory make_evaluators(AllowedPrograms allowed = {});

}  // namespace swarmsmith
