#pragma once

#include <vector>

#include "sim/engine/internal/body.h"
#include "sim/mission/solid.h"

namespace swarmsmith {

/// A solid's outline as sensors and contacts want it, in its own frame.
struct Form {
  /// Counter-clockwise and convex; empty for a circle.
  std::vector<Point> corners;
  double radius_m = 0;    ///< of the circle, or of the smallest one around the origin
  double inradius_m = 0;  ///< of the largest circle around the origin that fits into it
  double height_m = 0;
  /// A square of the robot's side, for which there are quicker ways.
  bool is_rvr = false;

  bool is_circle() const { return corners.empty(); }
  friend bool operator==(const Form&, const Form&) = default;
};

Form form_of(const Outline& outline, double height_m);

/// A solid that never moves.
struct FixedSolid {
  Form form;
  Body at;  ///< without velocity

  friend bool operator==(const FixedSolid&, const FixedSolid&) = default;
};

}  // namespace swarmsmith
