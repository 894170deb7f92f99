#pragma once

#include <vector>

#include "sim/engine/internal/body.h"
#include "sim/mission/arena.h"

namespace swarmsmith {

/// A wall as sensors and contacts want it: the line through its inner face, and where on that line
/// the face begins and ends.
struct WallPlane {
  double nx = 0;  ///< unit normal, pointing out of the arena
  double ny = 0;
  double offset_m = 0;  ///< points p of the face have n . p = offset
  Point from;
  double length_m = 0;  ///< the face runs from `from` along (-ny, nx)

  /// How far a point is inside of the line; negative behind it.
  double depth_of(double x, double y) const { return offset_m - nx * x - ny * y; }
  /// Coordinate of a point along the face, 0 at `from`.
  double along(double x, double y) const { return nx * (y - from.y) - ny * (x - from.x); }

  friend bool operator==(const WallPlane&, const WallPlane&) = default;
};

struct Walls {
  std::vector<WallPlane> planes;
  /// Then each wall bounds the arena with its whole line.
  bool convex = true;
  /// Radius of a circle around the origin that no wall's line enters; negative if there is none.
  double clear_radius_m = 0;
};

Walls walls_of(const Arena& arena);

/// Of `walls`, those whose lines are at most so far from a place, on either side; replaces what was
/// in `near`.
void find_walls_near(const Walls& walls, const Body& place, double distance_m, Walls& near);

/// Gap between two robots' squares along the best separating axis, metres: a lower bound of their
/// distance, negative when they overlap.
double gap_between(const Body& a, const Body& b);

/// Gap between a robot's square and the line of a wall; negative behind it.
double gap_to(const Body& body, const WallPlane& wall);

}  // namespace swarmsmith
