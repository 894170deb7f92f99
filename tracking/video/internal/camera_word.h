#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/expected.h"
#include "tracking/geometry/camera_model.h"

namespace swarmsmith {

/// Whether a word means a camera: `camera:0`, `camera:0:1920x1080@60`, `opencv:WORD`, an address
/// (`rtsp://...`), a GStreamer pipeline (`v4l2src ! ...`).
bool is_camera_word(std::string_view word);

/// What a word asks for.
struct CameraWord {
  std::string name;          ///< the whole word
  std::optional<int> index;  ///< of a device, or
  std::string address;       ///< for OpenCV
  ImageSize size;            ///< 0 x 0: the driver's choice
  double frame_rate = 0;     ///< 0: the driver's choice
  bool is_file = false;
};

/// E_CONFIG for a `camera:` that is not written like that.
Expected<CameraWord> camera_word(const std::string& word);

}  // namespace swarmsmith
