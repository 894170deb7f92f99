#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "tracking/observing/observations.h"

namespace swarmsmith {

/// Gathers where floor tags are seen into medians over spans of some seconds, so that a camera that
/// is pushed shows, and read noise does not.
class ReferenceMedians {
 public:
  explicit ReferenceMedians(double span_s) : span_s_(span_s) {}

  /// Times increase.
  void add(double time_s, int tag, const TagCorners& corners);
  /// By time, then tag; nothing is left after it.
  std::vector<ReferenceLook> take();

 private:
  void close_span(double until_s);

  double span_s_;
  std::optional<double> first_s_;
  double last_s_ = 0;
  std::int64_t span_ = 0;
  std::map<int, std::vector<TagCorners>> seen_;  ///< in the present span, by tag
  std::vector<ReferenceLook> looks_;
};

}  // namespace swarmsmith
