#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "sim/mission/arena.h"
#include "sim/mission/pose.h"
#include "sim/mission/solid.h"

namespace swarmsmith {

/// The ground that a solid covers at its pose; convex.
class Footprint {
 public:
  Footprint(const Outline& outline, const Pose& pose);

  Point centre() const { return centre_; }
  /// Counter-clockwise; empty for a circle.
  std::span<const Point> corners() const { return {corners_.data(), count_}; }
  double radius_m() const { return radius_m_; }  ///< for a circle, else 0

  /// Extent along the unit vector (x, y): p . (x, y) is between `least` and `most` for all its
  /// points p.
  struct Extent {
    double least;
    double most;
  };
  Extent along(double x, double y) const;

 private:
  void add_corner(Point own, double cos, double sin);

  Point centre_;
  std::array<Point, 8> corners_;
  std::size_t count_ = 0;
  double radius_m_ = 0;
};

/// Radius of the largest circle around the centre of mass within the outline.
double inradius_of(const Outline& outline);
/// The largest distance of the outline from the centre of mass.
double circumradius_of(const Outline& outline);

/// Whether two solids overlap.
bool overlap(const Footprint& a, const Footprint& b);

/// Whether a solid crosses the face of a wall.
bool crosses(const Footprint& solid, const Wall& wall);

}  // namespace swarmsmith
