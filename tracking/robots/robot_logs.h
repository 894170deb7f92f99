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

/// Compares the robots' own logs of a run with the camera's observations. Pure.

/// The machine that should have run on the robots.
struct RanMachine {
  std::string text;     ///< in the grammar, as programs print it
  std::string flavour;  ///< name of its flavour
};

/// E_LOG_FOREIGN if a log does not belong to this run, robot and machine. `machine` is nothing if
/// it is unknown which machine should have run; then the machine is not checked.
std::optional<Issue> misfit_of(const RobotLog& log, const RunLog& run,
                               const std::optional<RanMachine>& machine);
/// The same for robots that should all have run the same machine as the first log.
std::optional<Issue> other_machine(const RobotLog& log, const RobotLog& first);

/// A node writes rows every second; if it is killed, it loses the rows that it had not written.
inline constexpr double kLostAtTheEnd_s = 1.0;
/// `swarmsmith-robot start` refuses a larger offset, too.
inline constexpr double kClockOffset_s = 0.02;
/// Shares of the cycles of a run that may be lost (ros facts, 3.4 and 3.6).
inline constexpr double kDegradedShare = 0.01;
inline constexpr double kInvalidShare = 0.05;

/// The node stops treads that have not obeyed for `kDriverOff_s`, and ends the run after
/// `kDriverGone_s` (docs/robot-messages.md).
inline constexpr double kDriverOff_s = 0.3;
inline constexpr double kDriverGone_s = 1.0;

/// The largest latency of the treads: the time that a driver may take, and the uncertainty from the
/// time between two frames.
inline constexpr double kLateTreads_s = 0.35;
/// The largest difference, as a share, between driven and commanded distance; beyond it the treads
/// slip or their scale is wrong.
inline constexpr double kWayOff = 0.3;
/// Whether the limit is exceeded even after the error is subtracted.
bool is_late(const Latency& latency);
bool is_off(const Gain& way);

/// The conclusions from the robots' logs and from the notes of `start` on their nodes.
struct RobotFindings {
  std::vector<std::optional<Latency>> latencies;  ///< by tracked robot; none without a log
  std::vector<std::optional<Reality>> reality;    ///< by tracked robot; none without a log
  std::vector<Issue> issues;
  std::vector<Check> checks;
  bool logs_confirm_clock = false;  ///< film and robots' logs agree on the speed of time
};

/// Gives E_ROBOT_INVALID and W_ROBOT_DEGRADED according to the nodes' own verdicts; a node that was
/// killed has no verdict, so the cycles missing from its log decide. Also gives E_LOG_SHORT,
/// W_CLOCK_OFFSET, W_MOTION_UNLIKE_LOG if a robot did not do what its log commanded, and
/// E_FILM_SPEED if the film's clock and the robots' clocks run at different speeds.
RobotFindings judge_robots(const TrackedRun& run, const std::vector<RobotLog>& logs,
                           const RunLog& log);

/// The checks of the robots' logs, including checks that could not be done because a log is
/// missing. `findings` are the result of judge_robots.
std::vector<Check> checks_of_logs(const TrackedRun& run, const Observations& observations,
                                  const RunLog& log, const RobotFindings& findings);

/// The number of control cycles in a log, and how late they began.
struct LogCounts {
  std::int64_t stepped = 0;
  std::int64_t held = 0;     ///< treads were stopped because a sensor was silent
  std::int64_t skipped = 0;  ///< have no row; those after the last row are not counted
  double late_median_ms = 0;
  double late_most_ms = 0;
};
/// As counted by the node, or from the rows if the node was killed.
LogCounts log_counts(const RunRecord& record);

}  // namespace swarmsmith
