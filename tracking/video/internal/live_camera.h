#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// The longest times that a camera may take before it counts as failed.
struct CameraPatience {
  std::chrono::milliseconds opening{15'000};
  std::chrono::milliseconds frame{5'000};
};

/// Opens a camera through OpenCV. Times are the driver's (Video4Linux: the machine's monotonic
/// clock); otherwise the monotonic clock when the picture arrived, minus half a frame. Frames that
/// are not fetched in time are left out and counted. A file (`opencv:run.mkv`) plays at its own
/// rate, like a camera.
Expected<std::unique_ptr<FrameSource>> open_camera(const std::string& word,
                                                   const CameraPatience& patience = {});

}  // namespace swarmsmith
