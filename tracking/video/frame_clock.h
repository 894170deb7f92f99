#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "tracking/rig/time_source.h"
#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// Reads the frame times that a camera's program wrote beside the video: CSV with the columns
/// `frame` (from 0, without gaps) and `time_s`, `time_ms`, `time_us`, `time_ns`, or `time` with ISO
/// 8601 dates (increasing, on the camera's clock).
Expected<std::vector<double>> parse_frame_times(std::string_view text);

/// The time of each frame: from the sidecar if there is one, otherwise from the container,
/// otherwise counted with the nominal rate, in this order of trust (tracking facts, section 7).
class FrameClock {
 public:
  /// `sidecar` are its times, or nothing. E_TIMESTAMPS if there is no sidecar, the container has no
  /// times, and the rate is not constant.
  static Expected<FrameClock> of(const SourceInfo& source,
                                 std::optional<std::vector<double>> sidecar);

  TimeSource source() const { return source_; }
  /// E_TIMESTAMPS, with the frame, if its time is missing or not later than the time of the
  /// previous frame; E_SIDECAR_MISMATCH for a frame after the sidecar's end.
  Expected<double> time_of(const Frame& frame);
  /// E_SIDECAR_MISMATCH if the sidecar has more rows than `frames`, the number of frames including
  /// damaged ones.
  Expected<void> finish(std::int64_t frames) const;

 private:
  TimeSource source_ = TimeSource::Container;
  std::string name_;
  std::vector<double> sidecar_;
  double frame_rate_ = 0;
  std::optional<double> last_;
};

}  // namespace swarmsmith
