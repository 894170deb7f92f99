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

/// Why a log is not of this run, robot and machine: E_LOG_FOREIGN. `machine` is nothing when the
/// caller says what ran.
std::optional<Issue> misfit_of(const RobotLog& log, const RunLog& run,
                               const std::optional<RanMachine>& machine);
/// The same for robots that should all have run one machine: that of the first log.
std::optional<Issue> other_machine(const RobotLog& log, const RobotLog& first);

/// A node that is killed loses what it had not written yet: rows are written each second.
inline constexpr double kLostAtTheEnd_s = 1.0;
/// Beyond it `swarmsmith-robot start` refuses, too.
inline constexpr double kClockOffset_s = 0.02;
/// Shares of the cycles of a run (ros facts, 3.4 and 3.6).
inline constexpr double kDegradedShare = 0.01;
inline constexpr double kInvalidShare = 0.05;

/// Treads that did not obey stand then, and their run is over then (docs/robot-messages.md).
inline constexpr double kDriverOff_s = 0.3;
inline constexpr double kDriverGone_s = 1.0;

/// Treads act so late at most: what their driver may take, and what hides between two frames.
inline constexpr double kLateTreads_s = 0.35;
/// They drive so much less or more than they were told at most: they slip, or their scale is wrong.
inline constexpr double kWayOff = 0.3;
/// Whether they are beyond that for sure, errors taken off.
bool is_late(const Latency& latency);
bool is_off(const Gain& way);

/// What follows from the robots' logs and from what `start` noted of their nodes.
struct RobotFindings {
  std::vector<std::optional<Latency>> latencies;  ///< as the tracked robots; none without a log
  std::vector<std::optional<Reality>> reality;    ///< likewise
  std::vector<Issue> issues;
  std::vector<Check> checks;
  bool logs_confirm_clock = false;  ///< the film plays as fast as the robots' logs say
};

/// E_ROBOT_INVALID and W_ROBOT_DEGRADED by the nodes' own verdicts; of a node that has none, since
/// it was killed, by the cycles that its log lacks. E_LOG_SHORT, W_CLOCK_OFFSET, and
/// W_MOTION_UNLIKE_LOG for a robot that did something else than it commanded. E_FILM_SPEED when the
/// film's clock runs at another speed than theirs.
RobotFindings judge_robots(const TrackedRun& run, const std::vector<RobotLog>& logs,
                           const RunLog& log);

/// What the robots' logs were asked, and of what robots there is none. `findings` are those of
/// judge_robots.
std::vector<Check> checks_of_logs(const TrackedRun& run, const Observations& observations,
                                  const RunLog& log, const RobotFindings& findings);

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
