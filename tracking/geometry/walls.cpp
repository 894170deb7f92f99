#include "tracking/geometry/walls.h"

#include <algorithm>
#include <limits>

#include "base/math.h"

namespace swarmsmith {

double distance_to_walls(const Arena& arena, Point point) {
  double least = std::numeric_limits<double>::infinity();
  for (const Wall& wall : arena.walls) {
    const double dx = wall.to.x - wall.from.x;
    const double dy = wall.to.y - wall.from.y;
    const double along = (point.x - wall.from.x) * dx + (point.y - wall.from.y) * dy;
    const double share = std::clamp(along / (dx * dx + dy * dy), 0.0, 1.0);
    least = std::min(least,
                     hypot(point.x - wall.from.x - share * dx, point.y - wall.from.y - share * dy));
  }
  return least;
}

}  // namespace swarmsmith
