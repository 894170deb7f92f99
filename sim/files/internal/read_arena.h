#pragma once

#include <filesystem>

#include "base/text/table_reader.h"
#include "sim/mission/mission.h"

namespace swarmsmith {

/// The [mission.arena] table: walls, floor, and what stands in the arena; files are found from
/// `folder`.
void read_arena(TableReader& table, const std::filesystem::path& folder, Mission& mission);

}  // namespace swarmsmith
