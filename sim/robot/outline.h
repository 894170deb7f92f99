#pragma once

#include <variant>
#include <vector>

#include "sim/robot/point.h"

namespace swarmsmith {

/// Outlines are given in the solid's own frame: the origin is its centre of mass, x points forward.

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
