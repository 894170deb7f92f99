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

/// The distance of a robot's last position from the border where its score would change.
struct BorderDistance {
  double signed_m = 0;     ///< positive on the side that counts
  std::string border;      ///< "spot at (0, 0.5)", "green patch at (0.3, 0)"
  bool too_close = false;  ///< the distance is less than three times its sigma
  double sigma_m = 0;      ///< of the robot's coordinates at this instant
};

struct ScoredRun {
  std::vector<Patch> patches;   ///< patches of this run, in addition to the arena's own
  std::optional<double> score;  ///< none if the run cannot be scored at all
  Verdict verdict = Verdict::Valid;
  bool biased = false;                                 ///< a tag was taken for its robot's centre
  std::vector<std::string> reasons;                    ///< reasons for the verdict, a sentence each
  std::vector<std::optional<BorderDistance>> borders;  ///< per robot; if the last instant is scored
  /// Latency of each robot's motion behind its commands; none for a robot without a log. Empty if
  /// it was not computed.
  std::vector<std::optional<Latency>> latencies;
  /// Results of comparing each robot's log with the camera; as for `latencies`.
  std::vector<std::optional<Reality>> reality;
  std::vector<Issue> issues;  ///< all issues: of files, times, tracking, scoring
  std::vector<Check> checks;  ///< all checks, including those that could not be done
};

}  // namespace swarmsmith
