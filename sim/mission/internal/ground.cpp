#include "sim/mission/internal/ground.h"

#include <algorithm>
#include <utility>

#include "sim/mission/polygon.h"

namespace swarmsmith {

Ground::Ground(const Arena& arena, bool ignores_obstacles)
    : arena_(&arena), corners_(corners_of(arena)) {
  if (ignores_obstacles) return;
  for (std::size_t i = 0; i < arena.obstacles.size(); ++i) {
    const Obstacle& obstacle = arena.obstacles[i];
    add({obstacle.outline, obstacle.pose}, "obstacle " + std::to_string(i + 1));
  }
}

std::string Ground::blocked_by(const Footprint& solid) const {
  for (const Wall& wall : arena_->walls) {
    if (crosses(solid, wall)) return "a wall";
  }
  // A solid that crosses no wall is inside or outside the arena as a whole.
  if (!is_within(corners_, solid.centre())) return "a wall";
  for (const Standing& other : standing_) {
    if (overlap(solid, other.footprint)) return other.name;
  }
  return "";
}

void Ground::add(const Footprint& solid, std::string name) {
  standing_.push_back({solid, std::move(name)});
}

Rectangle Ground::bounds() const {
  Point least = corners_.front();
  Point most = least;
  for (const Point corner : corners_) {
    least = {std::min(least.x, corner.x), std::min(least.y, corner.y)};
    most = {std::max(most.x, corner.x), std::max(most.y, corner.y)};
  }
  return {.centre = {(least.x + most.x) / 2, (least.y + most.y) / 2},
          .width_m = most.x - least.x,
          .height_m = most.y - least.y};
}

}  // namespace swarmsmith
