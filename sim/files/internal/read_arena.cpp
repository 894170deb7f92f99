#include "sim/files/internal/read_mission.h"

#include "sim/files/internal/read_solids.h"

namespace swarmsmith {

void read_arena(TableReader& table, const ImageSource& images, Mission& mission) {
  const std::size_t before = table.complaints();
  read_walls(table, mission);
  const auto height = table.number("wall_height", {0.001, 100});
  mission.arena.wall_height_m = height.value_or(mission.arena.wall_height_m);
  read_floor(table, images, mission);
  read_solids(table, mission.arena);
  table.finish();
  // After other errors in the arena, misplaced solids are not reported.
  if (table.complaints() != before) return;
  if (const auto misplaced = misplaced_solid(mission.arena)) {
    table.complain(misplaced->starts_with("object") ? "objects" : "obstacles", *misplaced);
  }
}

}  // namespace swarmsmith
