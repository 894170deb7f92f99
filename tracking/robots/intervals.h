#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tracking/motion/tracked_run.h"

namespace swarmsmith {

/// What the camera saw of a robot between two of its frames.
struct SeenInterval {
  double from_s = 0;
  double to_s = 0;
  double ahead_m = 0;  ///< along the heading in the middle
  double aside_m = 0;
  double turn_rad = 0;
};

/// Between each two samples of one camera that were used, up to a time. Samples that are over 0.25
/// s apart say nothing of when something happened between them, and give none.
std::vector<SeenInterval> intervals_of(std::span<const Sample> seen, double until_s);

}  // namespace swarmsmith
