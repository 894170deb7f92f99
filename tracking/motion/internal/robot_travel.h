#pragma once

#include <span>
#include <vector>

#include "tracking/motion/internal/robot_track.h"
#include "tracking/motion/internal/travel.h"

namespace swarmsmith {

/// Checks for each robot whether it moves as robots can: whether its tag is where it was calibrated
/// (E_TAG_TURNED; W_HEADING_OFF if positions are not affected), and whether something other than
/// its treads moved it (E_PUSHED). `robots` and `tracks` belong to the run; the run's trajectory
/// and its other issues must be complete.
void judge_travel(const std::vector<TaggedRobot>& robots, const std::vector<RobotTrack>& tracks,
                  const Arena& arena, const TrackOptions& options, TrackedRun& run);

}  // namespace swarmsmith
