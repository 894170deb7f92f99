#pragma once

#include <optional>
#include <span>
#include <string>

#include "tracking/motion/tracked_run.h"

namespace swarmsmith {

/// The commanded speeds of a robot's treads, from a time of the run until the next command.
struct TimedCommand {
  double time_s = 0;
  double left_mps = 0;
  double right_mps = 0;
};

/// The time between a robot's commands and its motion.
struct Latency {
  std::optional<double> seconds;  ///< none if it cannot be determined
  double error_s = 0;             ///< one standard error of `seconds`, or of a rejected estimate
  /// Correlation of commanded and seen motion at the best shift, -1 to 1: of turns if turns were
  /// commanded, otherwise of distances. None if the robot did not move.
  std::optional<double> agreement;
  bool beyond = false;  ///< the best shift is at the end of the range of shifts
  std::string reason;   ///< why it cannot be determined, a sentence without its subject
};

/// A robot with a smaller agreement does not follow its log. The agreement of two robots that
/// explore is about 0, and that of a robot which is sometimes pushed is over 0.8.
inline constexpr double kLeastAgreement = 0.5;

/// The shift in time at which the commanded motion explains the seen motion best, by least squares
/// over the distance and the turn between consecutive samples. Treads follow their commands with a
/// limited acceleration, one for driving and one for turning. These limits are fitted together with
/// the shift, so that the time needed to reach a speed is not part of the latency. The distance
/// ahead, the distance to the side and the turn each have a gain (treads slip; a heading may be off
/// by a constant angle), and are weighted by the variance of their own residuals. This is the
/// likelihood of normal errors with unknown variances, and its curvature gives the standard error.
/// If the sandwich estimate over blocks of 2 s is larger, as for a latency that varies, it is the
/// standard error.
///
/// `commands` and `seen` are sorted by time and use the same clock; only samples that were used
/// count. Before the first command the treads do not move.
Latency latency_of(std::span<const TimedCommand> commands, std::span<const Sample> seen);

}  // namespace swarmsmith
