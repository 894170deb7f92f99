#pragma once

#include <memory>
#include <string>

#include "base/expected.h"
#include "tracking/video/frame_source.h"

namespace swarmsmith {

struct VideoOptions {
  /// "h264" (even width and height), "mjpeg", or "ffv1", which keeps the brightness without loss.
  std::string codec = "h264";
  double frame_rate = 30;  ///< nominal; each frame has its own time
  int quality = 80;        ///< 1 to 100; 100 looks lossless and is large
  int b_frames = 0;        ///< for h264, most in a row: a smaller file, but more delay
  /// A recording that may be interrupted at any time: the file has its name from the start, and all
  /// but its last half second is readable, whatever happens to the program. Only .mkv.
  bool live = false;
};

/// Writes a video with a time for each frame: .mkv (times to 1 ms), .mp4 (to 1 us), or .avi, which
/// only has a constant rate. The same pictures and times give the same bytes. Unless it is live,
/// the file gets its name only in `finish`; without `finish`, no file remains.
class VideoWriter {
 public:
  /// E_CONFIG for an impossible extension, codec, size or rate; Unavailable if the file cannot be
  /// written.
  static Expected<VideoWriter> open(const std::string& path, ImageSize size,
                                    const VideoOptions& options);
  VideoWriter(VideoWriter&&) noexcept;
  VideoWriter& operator=(VideoWriter&&) noexcept;
  ~VideoWriter();

  /// `time_s` must not be negative, and must be later than the previous frame by at least the
  /// container's resolution; in an .avi it must be the frame's number divided by the rate. BadInput
  /// for a wrong time or size; Unavailable, with the system's message, if the disk is full or
  /// missing.
  Expected<void> write(const GrayImage& image, double time_s);
  Expected<void> write(const ColorImage& image, double time_s);
  /// Completes the file. Must be called once, and last.
  Expected<void> finish();

 private:
  struct State;
  explicit VideoWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace swarmsmith
