#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tracking/motion/tracked_run.h"
#include "tracking/observing/observations.h"
#include "tracking/rig/rig.h"
#include "tracking/rig/run_log.h"
#include "tracking/scoring/scored_run.h"

namespace swarmsmith {

/// A person's word on a run, above the verdict.
struct VerdictOverride {
  Verdict verdict = Verdict::Valid;
  std::string who;
  std::string reason;
};

/// All that is known of a scored run. The references must live as long as the value.
struct ReportedRun {
  const Rig& rig;
  const RunLog& log;
  const Observations& observations;
  const TrackedRun& tracked;
  const ScoredRun& scored;
  std::vector<Patch> patches;              ///< that the run was scored with, over the arena's own
  std::vector<VerdictOverride> overrides;  ///< oldest first; the last one counts
  std::string program;                     ///< what scored it, with the versions of its libraries
};

/// The quality report (tracking facts, section 11) as a JSON object, docs/tracking.md lists its
/// keys: what is stored with a score. Lengths in metres, angles in radians, as `_px` pixels.
std::string quality_json(const ReportedRun& run);

/// The same as one page of HTML, the verdict first, with the run from above and a timeline.
std::string quality_html(const ReportedRun& run);

}  // namespace swarmsmith
