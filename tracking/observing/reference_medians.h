#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "tracking/observing/observations.h"

namespace swarmsmith {

/// Collects the corners of floor tags into medians over spans of some seconds, so that a pushed
/// camera is visible and noise is not.
class ReferenceMedians {
 public:
  explicit ReferenceMedians(double span_s) : span_s_(span_s) {}

  /// Times must increase.
  void add(double time_s, int tag, const TagCorners& corners);
  /// Returns the looks by time, then tag, and clears them.
  std::vector<ReferenceLook> take();

 private:
  void close_span(double until_s);

  double span_s_;
  std::optional<double> first_s_;
  double last_s_ = 0;
  std::int64_t span_ = 0;
  std::map<int, std::vector<TagCorners>> seen_;  ///< in the current span, by tag
  std::vector<ReferenceLook> looks_;
};

}  // namespace swarmsmith
