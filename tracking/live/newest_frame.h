#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "base/expected.h"
#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// A frame with its own copy of the pixels.
struct GrabbedFrame {
  std::int64_t number = 0;
  double time_s = 0;
  ImageSize size;
  std::vector<std::uint8_t> gray;
  std::optional<ColorImage> color;           ///< in some frames, while a client wants colours
  std::chrono::steady_clock::time_point in;  ///< when the source received it

  GrayImage image() const { return {gray.data(), size.width, size.height, size.width}; }
};

/// Reads frames from a source in its own thread, and keeps the newest. A consumer that is slower
/// than the camera is therefore at most one frame late, and knows how many frames were dropped.
/// Frames of a file come at the speed of their times.
class NewestFrame {
 public:
  /// Called in the thread for each frame, with its time, as soon as the frame is available, to
  /// record it. An error ends the reading.
  using OnFrame = std::function<Expected<void>(FrameSource& source, double time_s)>;

  /// `source` must outlive this object.
  NewestFrame(FrameSource& source, OnFrame on_frame);
  ~NewestFrame();
  NewestFrame(const NewestFrame&) = delete;
  NewestFrame& operator=(const NewestFrame&) = delete;

  /// The newest frame that was not taken yet; nothing after `patience`, or at the end.
  std::optional<GrabbedFrame> take(std::chrono::milliseconds patience);
  void wants_color(bool wanted) { wants_color_ = wanted; }

  std::int64_t dropped() const { return dropped_; }
  /// Whether no more frames will come, and the last one was taken.
  bool has_ended() const;
  /// The error that ended the reading, unless it was the end of a file.
  std::optional<Error> error() const;

 private:
  void run();
  bool wait_for_turn(double time_s);
  GrabbedFrame grab(double time_s, std::chrono::steady_clock::time_point in);

  FrameSource* source_;
  OnFrame on_frame_;
  std::atomic<bool> wants_color_ = false;
  std::atomic<std::int64_t> dropped_ = 0;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<GrabbedFrame> newest_;
  std::optional<Error> error_;
  bool ended_ = false;
  bool stopping_ = false;
  std::optional<std::chrono::steady_clock::time_point> began_;  ///< when the thread started
  double first_s_ = 0;
  std::optional<std::chrono::steady_clock::time_point> last_color_;
  std::thread thread_;
};

}  // namespace swarmsmith
