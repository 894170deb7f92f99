#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tracking/motion/tracked_run.h"
#include "tracking/observing/observations.h"
#include "tracking/rig/run_log.h"
#include "tracking/robots/latency.h"
#include "tracking/robots/reality.h"

namespace swarmsmith {

/// What robots wrote down of a run, beside what the camera saw of it. Pure.

/// The machine that should have run.
struct RanMachine {
  std::string text;     ///< of the grammar, as programs print it
  std::string flavour;  ///< name
};

/// Why a log is not of this run, robot and machine: E_LOG_FOREIGN. `machine` is nothing when nobody
/// says what ran.
std::optional<Issue> misfit_of(const RobotLog& log, const RunLog& run,
                               const std::optional<RanMachine>& machine);
/// The same for robots that should all have run one machine: that of the first log.
std::optional<Issue> other_machine(const RobotLog& log, const RobotLog& first);

/// What follows from the robots' logs and from what `start` noted of their nodes.
struct RobotFindings {
  std::vector<std::optional<Latency>> latencies;  ///< as the tracked robots; none without a log
  std::vector<std::optional<Reality>> reality;    ///< likewise
  std::vector<Issue> issues;
};

/// E_ROBOT_INVALID and W_ROBOT_DEGRADED by the nodes' own verdicts; of a node that has none, since
/// it was killed, by the cycles that its log lacks. E_LOG_SHORT, W_CLOCK_OFFSET, and
/// W_MOTION_UNLIKE_LOG for a robot that did something else than it commanded.
RobotFindings judge_robots(const TrackedRun& run, const std::vector<RobotLog>& logs,
                           const RunLog& log);

/// Control cycles of a log, and how late they began.
struct LogCounts {
  std::int64_t stepped = 0;
  std::int64_t held = 0;     ///< treads stood, because a sensor was silent
  std::int64_t skipped = 0;  ///< no row; those after the last row are not known of
  double late_median_ms = 0;
  double late_most_ms = 0;
};
/// As the node counted, or by its rows when it was killed.
LogCounts log_counts(const RunRecord& record);

}  // namespace swarmsmith
