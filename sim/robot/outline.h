#pragma once

#include <variant>
#include <vector>

#include "sim/robot/point.h"

namespace swarmsmith {

/// Outlines lie in the thing's own frame, origin at its centre of mass, x forward.

struct CircleOutline {
  double radius_m = 0;

  friend bool operator==(const CircleOutline&, const CircleOutline&) = default;
};

struct BoxOutline {
  double length_m = 0;  ///< along x
  double width_m = 0;   ///< along y

  friend bool operator==(const BoxOutline&, const BoxOutline&) = default;
};

/// Convex, 3 to 8 corners, counter-clockwise.
struct PolygonOutline {
  std::vector<Point> corners;

  friend bool operator==(const PolygonOutline&, const PolygonOutline&) = default;
};

using Outline = std::variant<CircleOutline, BoxOutline, PolygonOutline>;

}  // namespace swarmsmith
