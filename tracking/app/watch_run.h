#pragma once

#include "tracking/app/run_plan.h"
#include "tracking/observing/observations.h"

namespace swarmsmith::cli {

/// Looks through the plan's videos, once, and says how far it is. A layout that is to be measured
/// is, from pictures on the way, and goes into the plan's log.
OrRefusal<Observations> watch_run(RunPlan& plan, Output& output);

}  // namespace swarmsmith::cli
