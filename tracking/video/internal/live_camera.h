#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// How long a camera may take before it is given up.
struct CameraPatience {
  std::chrono::milliseconds opening{15'000};
  std::chrono::milliseconds frame{5'000};
};

/// A camera through OpenCV. Times are the driver's (Video4Linux: the machine's monotonic clock),
/// else that clock when the picture came, less half a frame. Frames that are not fetched in time
/// are left out and counted. A file (`opencv:run.mkv`) plays as a camera would, at its rate.
Expected<std::unique_ptr<FrameSource>> open_camera(const std::string& word,
                                                   const CameraPatience& patience = {});

}  // namespace swarmsmith
