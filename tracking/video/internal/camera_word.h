#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/expected.h"
#include "tracking/geometry/camera_model.h"

namespace swarmsmith {

/// Whether a text means a camera: `camera:0`, `camera:0:1920x1080@60`, `opencv:WORD`, a URL
/// (`rtsp://...`), a GStreamer pipeline (`v4l2src ! ...`).
bool is_camera_word(std::string_view word);

/// The camera that a text describes: a device or an address.
struct CameraWord {
  std::string name;          ///< the whole text
  std::optional<int> index;  ///< index of a device
  std::string address;       ///< without a device: an address for OpenCV
  ImageSize size;            ///< 0 x 0: the driver's choice
  double frame_rate = 0;     ///< 0: the driver's choice
  bool is_file = false;
};

/// E_CONFIG for a `camera:` with wrong syntax.
Expected<CameraWord> camera_word(const std::string& word);

}  // namespace swarmsmith
