#pragma once

#include <optional>

#include "base/text/table_reader.h"
#include "sim/files/internal/read_floor.h"
#include "sim/mission/mission.h"
#include "sim/mission/score.h"

namespace swarmsmith {

/// The readers of the sections of a mission file; each section has its own source file.

/// Reads the [mission.arena] table: walls, floor, obstacles, objects and lights.
void read_arena(TableReader& table, const ImageSource& images, Mission& mission);

/// Reads the keys of [mission.arena] that define the walls. New walls also change the placement: a
/// dodecagon gets the disc of the thesis scaled to its size, other shapes get the whole arena.
void read_walls(TableReader& arena, Mission& mission);

/// Reads `training` of [mission.instances], the placement of robots.
void read_placement(TableReader& instances, Mission& mission);

/// Reads the [mission.score] table, which replaces the whole score of the preset. Errors are added
/// to the reader's complaints; nothing if the kind does not exist.
std::optional<ScoreRule> read_score(TableReader& score);

}  // namespace swarmsmith
