#pragma once

#include <span>
#include <vector>

#include "tracking/motion/internal/robot_tag.h"

namespace swarmsmith {

/// Adds to the sigmas of a run, which know the noise of what was seen, all else that a robot's
/// place may be off by: survey, lens, time (by the camera), height and tilt (by the robot); as the
/// arena file says them, or as the pictures show them where that is more (docs/tracking.md).
void add_known_errors(const std::vector<TrackedTag>& tags, const std::vector<TagEvidence>& evidence,
                      std::span<const TrackedCamera> cameras, const Rig& rig, TrackedRun& run);

}  // namespace swarmsmith
