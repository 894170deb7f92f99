#pragma once

#include <vector>

namespace swarmsmith {

/// A value from `x` on, until the next one.
struct StairPoint {
  double x = 0;
  double y = 0;

  friend bool operator==(const StairPoint&, const StairPoint&) = default;
};

/// The corners of the steps through points with growing x.
std::vector<StairPoint> stairs(const std::vector<StairPoint>& points);

/// The median of several staircases, from where all of them have begun to where the first ends.
std::vector<StairPoint> median_of(const std::vector<std::vector<StairPoint>>& lines);

}  // namespace swarmsmith
