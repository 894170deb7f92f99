#pragma once

#include <optional>

#include "tracking/motion/internal/robot_samples.h"

namespace swarmsmith {

/// The first span in which the floor tags, by the median, stand elsewhere than when the place was
/// found; tags that the calibration does not know, than when first seen. Covered tags have no look,
/// and one tag alone may have been kicked.
std::optional<Issue> camera_moved(const CameraRecord& record, const TrackedCamera& camera,
                                  const Rig& rig, const TrackOptions& options);

}  // namespace swarmsmith
