#pragma once

#include <optional>
#include <vector>

#include "tracking/motion/internal/robot_samples.h"
#include "tracking/motion/internal/tag_ways.h"
#include "tracking/motion/repeats.h"

namespace swarmsmith {

/// Issues and checks of one question after the other.
struct Findings {
  std::vector<Issue> issues;
  std::vector<Check> checks;

  /// With no issue the check has passed.
  void add(Check check, std::optional<Issue> issue = std::nullopt);
};

/// One camera whose times are in question.
struct FilmedCamera {
  const CameraRecord& record;
  const TrackedCamera& camera;
  const Repeats& repeats;
  std::vector<TagWay> tags;
  std::optional<double> length_s;  ///< by another clock
  double duration_s = 0;           ///< of the run
};

/// The period, when frame times are multiples of one as exactly as their container writes times:
/// a recorder may have counted frames, and no clock has said when they were taken. None of a clock
/// that runs since 1970, nor of fewer than 20 frames.
std::optional<double> counted_period_s(const std::vector<double>& times);

/// Repeated pictures, the film's length, a counted clock, and a clock that steps within the run:
/// then all robots that move are elsewhere at once, or hardly farther after a long interval.
void check_clock(const FilmedCamera& film, Findings& findings);

/// Robots that drive or turn faster than they can are in a film that plays too fast. The second
/// fastest is asked, since one may be carried.
void check_speeds(const std::vector<TrackedRobot>& robots, const TrackLimits& limits,
                  double duration_s, Findings& findings);

}  // namespace swarmsmith
