#pragma once

#include <string>

#include "worker/work_item.h"

namespace swarmsmith {

/// Evaluators that run the simulator: the machine is read in the method's flavour, the instance
/// made from mission and seed. Errors: bytes that are no scenario, another engine version, a
/// flavour that this program does not have.
Expected<Evaluator> make_simulation(const std::string& scenario);

}  // namespace swarmsmith
