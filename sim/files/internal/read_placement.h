#pragma once

#include "base/text/table_reader.h"
#include "sim/mission/mission.h"

namespace swarmsmith {

/// `training` of [mission.instances]: where robots start.
void read_placement(TableReader& instances, Mission& mission);

}  // namespace swarmsmith
