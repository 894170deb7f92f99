#pragma once

#include "base/expected.h"
#include "tracking/motion/tracked_run.h"
#include "tracking/rig/run_log.h"
#include "tracking/scoring/scored_run.h"

namespace swarmsmith {

/// Whether the mission's score depends only on the last instant.
bool is_scored_at_the_end(const Mission& mission);

/// Scores a measured trajectory with the simulator's own scoring code, and gives a verdict. Pure.
/// `patches` are the patches of this run; a mission with shuffled patches and without `patches` is
/// an E_LAYOUT_MISSING. `before` are the issues from observing, `asked` the checks so far.
Expected<ScoredRun> score_run(const TrackedRun& run, const Mission& mission,
                              const std::optional<std::vector<Patch>>& patches,
                              const std::vector<Issue>& before,
                              const std::vector<Check>& asked = {});

}  // namespace swarmsmith
