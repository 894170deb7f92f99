#pragma once

#include <optional>
#include <vector>

#include "tracking/motion/internal/robot_samples.h"
#include "tracking/motion/internal/tag_ways.h"
#include "tracking/motion/repeats.h"

namespace swarmsmith {

/// The issues and checks of several questions.
struct Findings {
  std::vector<Issue> issues;
  std::vector<Check> checks;

  /// Without an issue the check has passed, unless its outcome says otherwise.
  void add(Check check, std::optional<Issue> issue = std::nullopt);
};

/// A camera whose frame times are checked.
struct FilmedCamera {
  const CameraRecord& record;
  const TrackedCamera& camera;
  const Repeats& repeats;
  std::vector<TagWay> tags;
  std::optional<double> length_s;  ///< measured with another clock
  double duration_s = 0;           ///< length of the run
};

/// The period of frame times that are multiples of one period, within the precision of the
/// container. In this case the recorder may have counted frames without reading a clock. None for
/// times that count from 1970, and for fewer than 20 frames.
std::optional<double> counted_period_s(const std::vector<double>& times);

/// Checks repeated pictures, the film's length, whether the times were counted, and whether the
/// clock steps during the run. When the clock steps, all moving robots are suddenly elsewhere, or
/// have hardly moved after a long interval.
void check_clock(const FilmedCamera& film, Findings& findings);

/// If robots drive or turn faster than they can, the film plays too fast. The second fastest robot
/// decides, because one robot may have been carried.
void check_speeds(const std::vector<TrackedRobot>& robots, const TrackLimits& limits,
                  double duration_s, Findings& findings);

}  // namespace swarmsmith
