#pragma once

#include <vector>

#include "tracking/app/refusal.h"
#include "tracking/motion/track_run.h"
#include "tracking/observing/observations.h"
#include "tracking/rig/rig.h"
#include "tracking/rig/run_log.h"
#include "tracking/scoring/scored_run.h"

namespace swarmsmith::cli {

/// The results that follow from a run's sightings and its known facts.
struct RunAnalysis {
  std::vector<double> starts_s;  ///< of the run, on each camera's clock
  TrackedRun tracked;
  ScoredRun scored;
};

/// Pure: the same sightings, rig and log give the same bits, from a video or from a store. `rig` is
/// that of the run, `whole_rig` has those that stood by.
OrRefusal<RunAnalysis> analyse(const Observations& observations, const Rig& rig,
                               const Rig& whole_rig, const RunLog& log,
                               bool takes_tags_for_centres);

}  // namespace swarmsmith::cli
