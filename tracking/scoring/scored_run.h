#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/mission/mission.h"
#include "tracking/motion/tracked_run.h"
#include "tracking/rig/issue.h"
#include "tracking/robots/latency.h"
#include "tracking/robots/reality.h"

namespace swarmsmith {

/// How near a robot's last pose is to where its score would change.
struct BorderDistance {
  double signed_m = 0;     ///< positive inside of what counts
  std::string border;      ///< "spot at (0, 0.5)", "green patch at (0.3, 0)"
  bool too_close = false;  ///< less than three times its sigma
  double sigma_m = 0;      ///< of the robot's coordinates at that instant
};

struct ScoredRun {
  std::vector<Patch> patches;   ///< of this run, over the arena's own
  std::optional<double> score;  ///< none when the run cannot be scored at all
  Verdict verdict = Verdict::Valid;
  bool biased = false;                                 ///< a tag was taken for its robot's centre
  std::vector<std::string> reasons;                    ///< for the verdict, a sentence each
  std::vector<std::optional<BorderDistance>> borders;  ///< a robot; for scores of the last instant
  /// Of each robot's motion behind its commands; none where it has no log. Empty: not looked at.
  std::vector<std::optional<Latency>> latencies;
  /// What each robot's log and the camera tell of the world as it is; as `latencies`.
  std::vector<std::optional<Reality>> reality;
  std::vector<Issue> issues;  ///< all: of files, times, tracking, scoring
  std::vector<Check> checks;  ///< the same: all that was asked, and what could not be
};

}  // namespace swarmsmith
