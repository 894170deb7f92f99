#pragma once

#include <memory>
#include <string>

#include "base/expected.h"
#include "tracking/video/frame_source.h"

namespace swarmsmith {

struct VideoOptions {
  /// "h264" (even width and height), "mjpeg", or "ffv1", which keeps every bit of the brightness.
  std::string codec = "h264";
  double frame_rate = 30;  ///< nominal; frames lie where their times say
  int quality = 80;        ///< 1 to 100; 100 looks lossless and is large
  int b_frames = 0;        ///< of h264, at most in a row: smaller, but later
  /// A recording that may be cut off at any time: stands under its name from the start, and all
  /// but its last half second can be read whatever happens to the program. Only .mkv.
  bool live = false;
};

/// Writes a video whose frames lie at given times: .mkv (times to 1 ms), .mp4 (to 1 us), or .avi,
/// which knows nothing but a constant rate. The same pictures and times give the same bytes. Unless
/// it is live, the file stands under its name only after `finish`; without it, nothing is left.
class VideoWriter {
 public:
  /// E_CONFIG for what cannot be (ending, codec, size, rate), Unavailable when the file cannot be
  /// written.
  static Expected<VideoWriter> open(const std::string& path, ImageSize size,
                                    const VideoOptions& options);
  VideoWriter(VideoWriter&&) noexcept;
  VideoWriter& operator=(VideoWriter&&) noexcept;
  ~VideoWriter();

  /// `time_s` must be later than the frame before, by the container's grain, and not negative; in
  /// an .avi it must be the frame's number over the rate. BadInput for that and for another size;
  /// Unavailable, with the system's words, when the disk is full or gone.
  Expected<void> write(const GrayImage& image, double time_s);
  Expected<void> write(const ColorImage& image, double time_s);
  /// Ends the file. To be called once, and last.
  Expected<void> finish();

 private:
  struct State;
  explicit VideoWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace swarmsmith
