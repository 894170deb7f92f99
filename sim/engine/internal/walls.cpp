#include "sim/engine/internal/walls.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math.h"

namespace swarmsmith {

Walls walls_of(const Arena& arena) {
  Walls walls;
  walls.clear_radius_m = std::numeric_limits<double>::infinity();
  for (const Wall& wall : arena.walls) {
    const double dx = wall.to.x - wall.from.x;
    const double dy = wall.to.y - wall.from.y;
    const double length = hypot(dx, dy);
    const double nx = dy / length;
    const double ny = -dx / length;
    const double offset = nx * wall.from.x + ny * wall.from.y;
    walls.planes.push_back(
        {.nx = nx, .ny = ny, .offset_m = offset, .from = wall.from, .length_m = length});
    walls.clear_radius_m = std::min(walls.clear_radius_m, offset);
  }
  for (const WallPlane& plane : walls.planes) {
    for (const Wall& wall : arena.walls) {
      if (plane.depth_of(wall.from.x, wall.from.y) < -1e-9) walls.convex = false;
    }
  }
  return walls;
}

void find_walls_near(const Walls& walls, const Body& place, double distance_m, Walls& near) {
  near.planes.clear();
  near.convex = walls.convex;
  near.clear_radius_m = walls.clear_radius_m;
  for (const WallPlane& plane : walls.planes) {
    if (std::fabs(plane.depth_of(place.x, place.y)) <= distance_m) near.planes.push_back(plane);
  }
}

double gap_between(const Body& a, const Body& b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  // The widest of the four projections of the line between the centres on the axes of the squares,
  // minus the extents of both squares on that axis: half a side for the one, (|cos| + |sin|) times
  // that for the other, which is rotated.
  const double widest =
      std::max({std::fabs(dx * a.cos + dy * a.sin), std::fabs(dy * a.cos - dx * a.sin),
                std::fabs(dx * b.cos + dy * b.sin), std::fabs(dy * b.cos - dx * b.sin)});
  const double cosine = std::fabs(a.cos * b.cos + a.sin * b.sin);
  const double sine = std::fabs(a.cos * b.sin - a.sin * b.cos);
  return widest - kHalfSide_m * (1 + cosine + sine);
}

double gap_to(const Body& body, const WallPlane& wall) {
  const double ahead = std::fabs(wall.nx * body.cos + wall.ny * body.sin);
  const double aside = std::fabs(wall.ny * body.cos - wall.nx * body.sin);
  return wall.depth_of(body.x, body.y) - kHalfSide_m * (ahead + aside);
}

}  // namespace swarmsmith
