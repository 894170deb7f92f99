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

/// Times of frames that a camera's program wrote beside the video: CSV with the columns `frame`
/// (from 0, without gaps) and `time_s`, `time_ms`, `time_us` or `time_ns`, or `time` with dates as
/// ISO 8601 writes them (increasing, the camera's clock).
Expected<std::vector<double>> parse_frame_times(std::string_view text);

/// When each frame was taken: by the sidecar, else by the container, else by counting at the
/// nominal rate, in that order of trust (tracking facts, section 7).
class FrameClock {
 public:
  /// `sidecar`: its times, or nothing. E_TIMESTAMPS when there is neither sidecar, nor times in the
  /// container, nor a constant rate.
  static Expected<FrameClock> of(const SourceInfo& source,
                                 std::optional<std::vector<double>> sidecar);

  TimeSource source() const { return source_; }
  /// E_TIMESTAMPS for a time that is missing or not later than the one before, with the frame;
  /// E_SIDECAR_MISMATCH for a frame beyond the sidecar's end.
  Expected<double> time_of(const Frame& frame);
  /// E_SIDECAR_MISMATCH when the sidecar has more rows than `frames`, those that came and those
  /// that were damaged.
  Expected<void> finish(std::int64_t frames) const;

 private:
  TimeSource source_ = TimeSource::Container;
  std::string name_;
  std::vector<double> sidecar_;
  double frame_rate_ = 0;
  std::optional<double> last_;
};

}  // namespace swarmsmith
