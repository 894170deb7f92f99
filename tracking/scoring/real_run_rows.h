#pragma once

#include <optional>
#include <string>
#include <vector>

#include "storage/real_runs.h"
#include "tracking/observing/observations.h"
#include "tracking/rig/rig_file.h"
#include "tracking/scoring/scored_run.h"

namespace swarmsmith {

/// All that a run is made of, and what came out of it. The references must live as long as the
/// value.
struct RunToStore {
  const Rig& rig;  ///< with the robots of the run, in the order of the trajectory
  const std::string& arena_text;
  const RunLog& log;
  const Observations& observations;
  const std::vector<double>& starts_s;  ///< RunSpan
  const TrackedRun& tracked;
  const std::vector<Patch>& patches;  ///< that it was scored with, over the arena's own
  const ScoredRun& scored;
};

/// The run as rows. Left for the caller: the candidate, and of the score the report and the
/// program. The key is one of the videos' bytes and of where in them the run begins.
RealRunRows real_run_rows(const RunToStore& run);

/// What a run is scored from, without its videos.
struct StoredRun {
  Rig rig;  ///< with all robots and cameras of the arena file
  RunLog log;
  Observations observations;
};

/// The other way round, calibrations included; corners as stores keep them, which is all that
/// track_run looks at. Fails as parse_rig and parse_run_log do.
OrComplaints<StoredRun> stored_run(const RealRunRows& rows);

}  // namespace swarmsmith
