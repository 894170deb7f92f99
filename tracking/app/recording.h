#pragma once

#include <chrono>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>

#include "base/expected.h"
#include "console/output.h"
#include "tracking/video/frame_clock.h"
#include "tracking/video/frame_source.h"
#include "tracking/video/video_writer.h"

namespace swarmsmith {

/// BadInput for a name that does not end in .mkv, and for an existing file.
Expected<void> check_recording_name(const std::string& file);

/// Removes a recording that has no frame, with its frame times.
void remove_recording(const std::string& video);

/// Writes the frame times beside the video. Columns: frame, time_s since the first frame, and for a
/// camera clock_s, the time on its own clock. The file gets its name only when the video is
/// complete, because after a crash its rows may not agree with the frames on the disk, and the
/// video contains times, too.
class Sidecar {
 public:
  Sidecar(const std::string& video, bool has_clock);

  const std::string& file() const { return file_; }
  /// Whether a frame is later than the last one in the milliseconds of Matroska; only then it can
  /// be recorded. Pictures that a network delayed may arrive together.
  bool is_later(double time_s) const;
  Expected<void> add(std::int64_t frame, double time_s, double clock_s);
  Expected<void> finish();

 private:
  std::string file_;
  bool has_clock_;
  std::ofstream out_;
  std::optional<std::int64_t> last_ms_;
};

struct RecordingOptions {
  std::optional<double> seconds;                   ///< length after which to stop
  std::optional<double> rate;                      ///< frame rate for frames without times
  std::optional<FrameClock> clock = std::nullopt;  ///< the times of the source's sidecar
  bool paced = false;                              ///< delay frames until their times
};

/// Records one video, from the first frame to the last.
class Recording {
 public:
  /// `source` must outlive this object.
  Recording(FrameSource& source, VideoWriter writer, Sidecar sidecar, RecordingOptions options);

  /// Records all frames until the source ends, the time is over, or the user asks to stop.
  /// Afterwards the recording is complete, even after an error, unless the disk is full.
  Expected<void> run(Output& output);
  /// Clears the line of progress.
  void clear_line(Output& output) const;

  std::int64_t frames() const { return frames_; }
  std::int64_t dropped() const { return source_.damaged_frames() + too_close_; }
  double seconds() const { return last_s_; }
  const std::string& times_file() const { return sidecar_.file(); }
  /// A summary: "246 frames in 12.3 s, 20.0 a second, 0 dropped".
  std::string summary() const;

 private:
  using Clock = std::chrono::steady_clock;

  Expected<void> all_frames(Output& output);
  Expected<double> time_of(const Frame& frame);
  Expected<void> keep(double time, double clock);
  void wait_until(double time) const;
  void tell(Output& output);

  FrameSource& source_;
  VideoWriter writer_;
  Sidecar sidecar_;
  RecordingOptions options_;
  std::optional<double> first_;
  Clock::time_point started_;
  Clock::time_point next_line_ = Clock::now() + std::chrono::seconds(1);
  bool shown_ = false;
  std::int64_t frames_ = 0;
  std::int64_t too_close_ = 0;
  double last_s_ = 0;
};

}  // namespace swarmsmith
