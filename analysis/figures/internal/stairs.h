#pragma once

#include <vector>

namespace swarmsmith {

/// A value that is valid from `x` until the next point.
struct StairPoint {
  double x = 0;
  double y = 0;

  friend bool operator==(const StairPoint&, const StairPoint&) = default;
};

/// The corners of the steps through points with increasing x.
std::vector<StairPoint> stairs(const std::vector<StairPoint>& points);

/// The median of several staircases, from the last of their starts to the first of their ends.
std::vector<StairPoint> median_of(const std::vector<std::vector<StairPoint>>& lines);

}  // namespace swarmsmith
