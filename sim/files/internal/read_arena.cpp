#include "sim/files/internal/read_arena.h"

#include "sim/files/internal/read_floor.h"
#include "sim/files/internal/read_solids.h"
#include "sim/files/internal/read_walls.h"

namespace swarmsmith {

bool read_arena(TableReader& table, const std::filesystem::path& folder, Mission& mission) {
  const bool has_walls = read_walls(table, mission);
  const auto height = table.number("wall_height", {0.001, 100});
  mission.arena.wall_height_m = height.value_or(mission.arena.wall_height_m);
  read_floor(table, folder, mission);
  const bool has_solids = read_solids(table, mission.arena);
  table.finish();
  if (!has_walls || !has_solids) return false;
  const auto misplaced = misplaced_solid(mission.arena);
  if (!misplaced) return true;
  const bool is_object = misplaced->starts_with("object");
  table.complain(is_object ? "objects" : "obstacles", *misplaced);
  return false;
}

}  // namespace swarmsmith
