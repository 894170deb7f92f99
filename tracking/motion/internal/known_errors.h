#pragma once

#include <span>
#include <vector>

#include "tracking/motion/internal/robot_tag.h"

namespace swarmsmith {

/// The sigmas of a run contain only the noise of the sightings. This adds the other errors of a
/// robot's place: survey, lens and time (of the camera), height and tilt (of the robot). Each is
/// the value from the arena file, or the value that the pictures show if that is larger
/// (docs/tracking.md).
void add_known_errors(const std::vector<TrackedTag>& tags, const std::vector<TagEvidence>& evidence,
                      std::span<const TrackedCamera> cameras, const Rig& rig, TrackedRun& run);

}  // namespace swarmsmith
