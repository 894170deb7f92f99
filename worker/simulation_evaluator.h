#pragma once

#include "proto/scenario/scenario.h"
#include "worker/evaluator.h"

namespace swarmsmith {

/// An evaluator that runs the simulator: the machine is read in the method's flavour, the instance
/// made from mission and seed. Errors: another engine version, a flavour that this program does not
/// have.
Expected<Evaluator> make_simulation_evaluator(WorkerScenario scenario);

}  // namespace swarmsmith
