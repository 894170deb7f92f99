#pragma once

#include <vector>

#include "sim/engine/internal/body.h"
#include "sim/mission/arena.h"

namespace swarmsmith {

/// A wall as sensors and contacts use it: the line through its inner face, and the start and length
/// of the face on that line.
struct WallPlane {
  double nx = 0;  ///< unit normal, pointing out of the arena
  double ny = 0;
  double offset_m = 0;  ///< points p of the face satisfy n . p = offset
  Point from;
  double length_m = 0;  ///< the face runs from `from` along (-ny, nx)

  /// Distance of a point from the line, positive inside, negative behind it.
  double depth_of(double x, double y) const { return offset_m - nx * x - ny * y; }
  /// Coordinate of a point along the face, 0 at `from`.
  double along(double x, double y) const { return nx * (y - from.y) - ny * (x - from.x); }

  friend bool operator==(const WallPlane&, const WallPlane&) = default;
};

struct Walls {
  std::vector<WallPlane> planes;
  /// If true, each wall bounds the arena with its whole line.
  bool convex = true;
  /// Radius of a circle around the origin that no wall's line crosses; negative if there is none.
  double clear_radius_m = 0;
};

Walls walls_of(const Arena& arena);

/// The walls whose lines are at most this far from a place, on either side; replaces the content of
/// `near`.
void find_walls_near(const Walls& walls, const Body& place, double distance_m, Walls& near);

/// Gap in metres between the squares of two robots along the best separating axis: a lower bound of
/// their distance, negative when they overlap.
double gap_between(const Body& a, const Body& b);

/// Gap between a robot's square and the line of a wall; negative behind the line.
double gap_to(const Body& body, const WallPlane& wall);

}  // namespace swarmsmith
