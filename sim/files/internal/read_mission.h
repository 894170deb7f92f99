#pragma once

#include <optional>

#include "base/text/table_reader.h"
#include "sim/files/internal/read_floor.h"
#include "sim/mission/mission.h"
#include "sim/mission/score.h"

namespace swarmsmith {

/// The sections of a mission file, a file a section.

/// The [mission.arena] table: walls, floor, and what stands in the arena.
void read_arena(TableReader& table, const ImageSource& images, Mission& mission);

/// The keys of [mission.arena] that say where walls are. Other walls than the mission had also get
/// another placement: a dodecagon the disc of the thesis in proportion, other shapes the whole
/// arena.
void read_walls(TableReader& arena, Mission& mission);

/// `training` of [mission.instances]: where robots start.
void read_placement(TableReader& instances, Mission& mission);

/// The [mission.score] table, which replaces the preset's whole score. What is wrong goes to the
/// reader's complaints; nothing when there is no such kind.
std::optional<ScoreRule> read_score(TableReader& score);

}  // namespace swarmsmith
