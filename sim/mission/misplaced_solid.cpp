#include <cstddef>

#include "sim/mission/internal/ground.h"
#include "sim/mission/mission.h"

namespace swarmsmith {

std::optional<std::string> misplaced_solid(const Arena& arena) {
  Ground ground(arena);
  for (std::size_t i = 0; i < arena.obstacles.size(); ++i) {
    if (!is_inside(arena, arena.obstacles[i].pose.position())) {
      return "obstacle " + std::to_string(i + 1) + " is outside the walls";
    }
  }
  for (std::size_t i = 0; i < arena.objects.size(); ++i) {
    const Footprint object(arena.objects[i].outline, arena.objects[i].start);
    const std::string by = ground.blocked_by(object);
    const std::string name = "object " + std::to_string(i + 1);
    if (!by.empty()) return name + " would stand in " + by + "; objects need room";
    ground.add(object, name);
  }
  return std::nullopt;
}

}  // namespace swarmsmith
