#pragma once

#include "sim/files/table_reader.h"
#include "sim/mission/mission.h"

namespace swarmsmith {

/// The [mission.score] table.
void read_score(TableReader& score, Mission& mission);

}  // namespace swarmsmith
