#pragma once

#include <vector>

#include "tracking/motion/internal/robot_samples.h"

namespace swarmsmith {

/// What the floor tags tell of one camera. E_CAMERA_MOVED: from when on they stand, by the median,
/// elsewhere than when the place was found; tags that the calibration does not know, than when
/// first seen. W_CAMERA_UNCHECKED: fewer than two were seen, all the time
/// or at the end; one may have been kicked. And what makes its place doubtful. Adds what is wrong,
/// and what was asked.
void check_camera(const CameraRecord& record, const TrackedCamera& camera, const Rig& rig,
                  const TrackOptions& options, std::vector<Issue>& issues,
                  std::vector<Check>& checks);

}  // namespace swarmsmith
