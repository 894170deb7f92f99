#pragma once

#include "base/text/table_reader.h"
#include "sim/mission/mission.h"

namespace swarmsmith {

/// The keys of [mission.arena] that say where walls are. Other walls than the mission had also get
/// another placement: a dodecagon the disc of the thesis in proportion, other shapes the whole
/// arena.
void read_walls(TableReader& arena, Mission& mission);

}  // namespace swarmsmith
