#pragma once

#include <vector>

#include "tracking/motion/internal/robot_track.h"
#include "tracking/motion/track_run.h"

namespace swarmsmith {

/// Checks whether the bodies of the mission's robot fit beside each other, obstacles and walls
/// where the robots were seen. They do not if the real robots are smaller than the described ones.
void judge_bodies(const std::vector<RobotTrack>& tracks, const Arena& arena,
                  const TrackOptions& options, TrackedRun& run);

}  // namespace swarmsmith
