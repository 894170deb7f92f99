#pragma once

#include <vector>

#include "sim/engine/internal/body.h"
#include "sim/mission/solid.h"

namespace swarmsmith {

/// The outline of a solid in its own frame, prepared for sensors and contacts.
struct Form {
  /// Counter-clockwise and convex; empty for a circle.
  std::vector<Point> corners;
  double radius_m = 0;    ///< radius of the circle, or of the smallest circle around the origin
                          ///< that contains the outline
  double inradius_m = 0;  ///< radius of the largest circle around the origin that fits into the
                          ///< outline
  double height_m = 0;
  /// Outward unit normals; the side from a corner to the next has the normal of its index.
  std::vector<Point> normals;
  /// Moments of the solid's floor area, seen from the origin: mean distance, and mean square of the
  /// distance (moment of inertia per kilogram, at uniform density).
  double mean_radius_m = 0;
  double mean_radius2_m2 = 0;
  /// A square of the RVR's size, for which there are faster algorithms.
  bool is_rvr = false;

  bool is_circle() const { return corners.empty(); }
  friend bool operator==(const Form&, const Form&) = default;
};

Form form_of(const Outline& outline, double height_m);

/// The RVR's square.
const Form& rvr_form();

/// A solid that never moves.
struct FixedSolid {
  Form form;
  Body at;  ///< without velocity

  friend bool operator==(const FixedSolid&, const FixedSolid&) = default;
};

}  // namespace swarmsmith
