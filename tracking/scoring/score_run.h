#pragma once

#include "base/expected.h"
#include "tracking/motion/tracked_run.h"
#include "tracking/rig/run_log.h"
#include "tracking/scoring/scored_run.h"

namespace swarmsmith {

/// Whether the mission's score depends on the last instant alone.
bool is_scored_at_the_end(const Mission& mission);

/// The mission's score of a measured trajectory, by the simulator's own scoring code, and a verdict
/// on it. Pure. `patches` are those of this run; a mission with shuffled patches and none given is
/// E_LAYOUT_MISSING. `before` are the issues of observing, `asked` the checks.
Expected<ScoredRun> score_run(const TrackedRun& run, const Mission& mission,
                              const std::optional<std::vector<Patch>>& patches,
                              const std::vector<Issue>& before,
                              const std::vector<Check>& asked = {});

}  // namespace swarmsmith
