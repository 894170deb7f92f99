#pragma once

#include "proto/scenario/scenario.h"
#include "worker/evaluator.h"

namespace swarmsmith {

/// An evaluator that runs the simulator: it parses the machine with the method's flavour, and makes
/// the instance from mission and seed. Errors: another engine version, or a flavour that this
/// program does not have.
Expected<Evaluator> make_simulation_evaluator(WorkerScenario scenario);

}  // namespace swarmsmith
