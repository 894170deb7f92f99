#pragma once

#include "base/text/table_reader.h"
#include "sim/files/internal/read_floor.h"
#include "sim/mission/mission.h"

namespace swarmsmith {

/// The [mission.arena] table: walls, floor, and what stands in the arena.
void read_arena(TableReader& table, const ImageSource& images, Mission& mission);

}  // namespace swarmsmith
