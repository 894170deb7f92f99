#pragma once

#include "tracking/app/run_plan.h"
#include "tracking/observing/observations.h"

namespace swarmsmith::cli {

/// Looks through the plan's videos, once, and says how far it is.
OrRefusal<Observations> watch_run(RunPlan& plan, Output& output);

}  // namespace swarmsmith::cli
