#pragma once

#include <span>
#include <vector>

#include "tracking/motion/internal/robot_track.h"
#include "tracking/motion/internal/travel.h"

namespace swarmsmith {

/// Asks of each robot whether it moves as robots do: whether its tag sits as it was calibrated
/// (E_TAG_TURNED; W_HEADING_OFF where no position is moved by it), and whether something but its
/// treads moved it (E_PUSHED). `robots` and `tracks` are those of the run, whose trajectory and
/// issues are complete but for these.
void judge_travel(const std::vector<TaggedRobot>& robots, const std::vector<RobotTrack>& tracks,
                  const Arena& arena, const TrackOptions& options, TrackedRun& run);

}  // namespace swarmsmith
