#pragma once

#include "base/expected.h"
#include "sim/mission/mission.h"
#include "sim/mission/trajectory.h"
#include "storage/real_runs.h"

namespace swarmsmith {

/// A real run in the terms of the simulator: what it would have recorded.
struct FilmedRun {
  Mission mission;
  Instance instance;      ///< starts as they were filmed, patches as they lay
  Trajectory trajectory;  ///< at the control cycles
};

/// Reads the mission and puts the cycles together. Corrupt when the mission cannot be read or has
/// movable objects, a patch has a colour that is none, or cycles are missing.
Expected<FilmedRun> filmed_run(const RealRunRows& rows);

/// What the run's stored cycles score, by the scoring code that simulations are judged by. -0 is 0,
/// as in a store.
double score_again(const FilmedRun& run);

}  // namespace swarmsmith
