#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "tracking/geometry/camera_model.h"

namespace swarmsmith {

/// The brightness of an image, row by row; does not own its pixels.
struct GrayImage {
  const std::uint8_t* pixels = nullptr;
  int width = 0;
  int height = 0;
  std::ptrdiff_t stride = 0;  ///< bytes from one row to the next
};

/// Blue, green, red, one byte each, row by row without gaps.
struct ColorImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> bgr;
};

struct Frame {
  /// From 0, in display order. A frame that is left out keeps its number, so that rows of a sidecar
  /// and counted times stay correct.
  std::int64_t number = 0;
  std::optional<double> time_s;  ///< time from the container or the camera
  GrayImage gray;                ///< valid until the next frame is read
  std::string file;              ///< file name of a picture; empty for videos
};

struct SourceInfo {
  std::string name;  ///< of file, folder or device; for a bag with the requested topic
  ImageSize size;
  double frame_rate = 0;             ///< nominal; 0 if unknown
  std::int64_t expected_frames = 0;  ///< including damaged frames; 0 if unknown
  bool has_times = false;            ///< frames have reliable times
  bool has_count = false;            ///< constant rate, and as many frames as the header says
  bool is_truncated = false;         ///< the file ends earlier than its header says
  bool is_live = false;
  std::vector<std::string> oddities;  ///< reasons why tags may not be found, a sentence each
};

/// A source of frames: a video file, a folder of images, a ROS bag, or a camera.
class FrameSource {
 public:
  /// Opens `word`: a video file, a picture, a folder of images or of chapters (in the order of
  /// their names), a bag (`run.bag`, `run.mcap:/topic`), `camera:0`, or a text that OpenCV can open
  /// (`rtsp://...`). E_VIDEO_UNREADABLE with the decoder's message.
  static Expected<std::unique_ptr<FrameSource>> open(const std::string& word);
  virtual ~FrameSource() = default;

  virtual const SourceInfo& info() const = 0;
  /// Reads the next frame; false at the end. A frame that cannot be decoded is left out and
  /// counted; a frame of another size is an error.
  virtual Expected<bool> next() = 0;
  virtual const Frame& frame() const = 0;
  /// The current frame in colour.
  virtual ColorImage color() = 0;
  virtual std::int64_t damaged_frames() const = 0;
};

/// The file or folder of a source; for a bag without the topic. Other texts are returned unchanged.
std::string file_of_source(const std::string& word);

}  // namespace swarmsmith
