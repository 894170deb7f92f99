#pragma once

#include <vector>

#include "tracking/motion/internal/robot_samples.h"

namespace swarmsmith {

/// Checks with the floor tags whether a camera moved. E_CAMERA_MOVED: from some time on, the median
/// shift of the tags against the calibration of the camera's place is too large; a tag that is not
/// in the calibration is compared with its first sighting. W_CAMERA_UNCHECKED: during the run or at
/// its end, fewer than two tags were seen; a single one may have been kicked. Also adds doubts
/// about the camera's place (doubts_of_place). Adds issues and checks.
void check_camera(const CameraRecord& record, const TrackedCamera& camera, const Rig& rig,
                  const TrackOptions& options, std::vector<Issue>& issues,
                  std::vector<Check>& checks);

}  // namespace swarmsmith
