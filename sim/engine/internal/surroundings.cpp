#include "sim/engine/internal/surroundings.h"

namespace swarmsmith {

Surroundings surroundings_of(const Arena& arena) {
  Surroundings result{.walls = walls_of(arena), .obstacles = {}};
  for (const Obstacle& obstacle : arena.obstacles) {
    result.obstacles.push_back(
        {form_of(obstacle.outline, obstacle.height_m), body_at(obstacle.pose)});
  }
  return result;
}

}  // namespace swarmsmith
