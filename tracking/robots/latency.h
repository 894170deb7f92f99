#pragma once

#include <optional>
#include <span>
#include <string>

#include "tracking/motion/tracked_run.h"

namespace swarmsmith {

/// Speeds of the treads that a robot was told, from a time of the run on until the next command.
struct TimedCommand {
  double time_s = 0;
  double left_mps = 0;
  double right_mps = 0;
};

/// By how much a robot's motion is behind its commands.
struct Latency {
  std::optional<double> seconds;  ///< none when it cannot be told
  double error_s = 0;             ///< one standard error; of `seconds`, or of what was dismissed
  /// Of commanded and seen motion, -1 to 1, at the best shift: of the turns where turns were
  /// commanded, else of the way. None where nothing moved.
  std::optional<double> agreement;
  bool beyond = false;  ///< the best shift is at the end of what was tried
  std::string reason;   ///< why it cannot be told, a sentence without its subject
};

/// A robot that does not follow its log agrees less than this with it: two robots that explore have
/// about 0, one that is pushed now and then over 0.8.
inline constexpr double kLeastAgreement = 0.5;

/// The shift at which the commanded motion explains best what the camera saw: least squares over
/// the way and the turn between each two samples. Treads follow their commands with a limited
/// acceleration, of the way and of the turn, which is looked for with it, so that the time they
/// take to reach a speed is not part of the latency. The way ahead, the way aside and the turn have
/// a gain each (treads slip; a heading may be off by a constant angle), and weigh as their own
/// residuals say. That is the likelihood of normal errors whose variances are not known, and its
/// curvature gives the standard error; the sandwich over blocks of 2 s takes its place where it is
/// larger, as with a latency that varies.
///
/// `commands` and `seen` are sorted by time, and count time from the same instant; only samples
/// that were used count. Before the first command the treads stand.
Latency latency_of(std::span<const TimedCommand> commands, std::span<const Sample> seen);

}  // namespace swarmsmith
