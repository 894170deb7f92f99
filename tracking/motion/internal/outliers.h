#pragma once

#include <vector>

#include "tracking/motion/resampling.h"

namespace swarmsmith {

/// For each sample of one camera's track, whether it is credible. First by reach: samples form
/// chains in which each can be reached from the one before within the limits of speed and turn; of
/// two chains that contradict each other, the longer one stays. Then by jump: samples that are far
/// from the median of the five samples around them are dropped (tracking facts, section 8). `track`
/// is sorted by time.
std::vector<bool> believable(const std::vector<TimedPose>& track, const TrackLimits& limits);

}  // namespace swarmsmith
