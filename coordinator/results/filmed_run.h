#pragma once

#include "base/expected.h"
#include "sim/mission/mission.h"
#include "sim/mission/trajectory.h"
#include "storage/real_runs.h"

namespace swarmsmith {

/// A real run in the simulator's types, as if the simulator had recorded it.
struct FilmedRun {
  Mission mission;
  Instance instance;      ///< with the filmed start poses, and the patches as they lay
  Trajectory trajectory;  ///< sampled at the control cycles
};

/// Reads the mission and the cycles. Errors: Corrupt if the mission cannot be read or has movable
/// objects, if a patch has an unknown colour, or if cycles are missing.
Expected<FilmedRun> filmed_run(const RealRunRows& rows);

/// The score of the run's stored cycles, computed by the same code as for simulations. -0 becomes
/// 0, as in a store.
double score_again(const FilmedRun& run);

}  // namespace swarmsmith
