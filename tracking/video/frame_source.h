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

/// Brightness of an image, row by row; its owner is elsewhere.
struct GrayImage {
  const std::uint8_t* pixels = nullptr;
  int width = 0;
  int height = 0;
  std::ptrdiff_t stride = 0;  ///< bytes from row to row
};

/// Blue, green, red, a byte each, row by row without gaps.
struct ColorImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> bgr;
};

struct Frame {
  /// From 0, in the order of display; one that was left out leaves a hole, so that rows of a
  /// sidecar and counted times stay right.
  std::int64_t number = 0;
  std::optional<double> time_s;  ///< as the container or the camera says it
  GrayImage gray;                ///< lives until the next frame is asked for
  std::string file;              ///< of a picture; empty in videos
};

struct SourceInfo {
  std::string name;  ///< of file, folder or device, a bag's with the topic that was asked for
  ImageSize size;
  double frame_rate = 0;             ///< nominal; 0 when it is unknown
  std::int64_t expected_frames = 0;  ///< with the damaged ones; 0 when not known
  bool has_times = false;            ///< frames carry times worth trusting
  bool has_count = false;     ///< constant rate, and as many frames as the file says it should have
  bool is_truncated = false;  ///< a file that ends before its own header says
  bool is_live = false;
  std::vector<std::string> oddities;  ///< that explain it when tags are not found, a sentence each
};

/// Where frames come from: a video file, a folder of images, a bag of ROS, a camera.
class FrameSource {
 public:
  /// `word`: a video file, a picture, a folder of images or of chapters (in the order of their
  /// names), a bag (`run.bag`, `run.mcap:/topic`), `camera:0` or another word that OpenCV opens
  /// (`rtsp://...`). E_VIDEO_UNREADABLE with the decoder's own words.
  static Expected<std::unique_ptr<FrameSource>> open(const std::string& word);
  virtual ~FrameSource() = default;

  virtual const SourceInfo& info() const = 0;
  /// Goes on to the next frame; false at the end. A frame that cannot be decoded is left out and
  /// counted, a frame of another size is an error.
  virtual Expected<bool> next() = 0;
  virtual const Frame& frame() const = 0;
  /// The present frame in colour.
  virtual ColorImage color() = 0;
  virtual std::int64_t damaged_frames() const = 0;
};

/// The file or folder of a word: that of a bag without its topic. Other words as they are.
std::string file_of_source(const std::string& word);

}  // namespace swarmsmith
