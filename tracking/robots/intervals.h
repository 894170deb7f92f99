#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tracking/motion/tracked_run.h"

namespace swarmsmith {

/// The motion of a robot between two frames of a camera.
struct SeenInterval {
  double from_s = 0;
  double to_s = 0;
  double ahead_m = 0;  ///< along the mean heading
  double aside_m = 0;
  double turn_rad = 0;
};

/// The intervals between consecutive used samples of each camera, until `until_s`. Samples more
/// than 0.25 s apart give no interval, because they do not show when something happened between
/// them.
std::vector<SeenInterval> intervals_of(std::span<const Sample> seen, double until_s);

}  // namespace swarmsmith
