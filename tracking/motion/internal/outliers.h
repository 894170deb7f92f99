#pragma once

#include <vector>

#include "tracking/motion/resampling.h"

namespace swarmsmith {

/// Which samples of one camera's track to believe, one a sample. First by reach: samples from which
/// the next can be reached at the limits' speed and turn make chains, and of chains that contradict
/// each other the longer one stays. Then by jump: those that stand off from the median of the five
/// around them (tracking facts, section 8). `track` is sorted by time.
std::vector<bool> believable(const std::vector<TimedPose>& track, const TrackLimits& limits);

}  // namespace swarmsmith
