#pragma once

#include <filesystem>

#include "base/text/table_reader.h"
#include "sim/mission/mission.h"

namespace swarmsmith {

/// The keys `floor`, `spots` and `shuffled` of [mission.arena]. Spots replace all of the preset's,
/// since one cannot take away what is not named. Images are found from `folder`.
void read_floor(TableReader& arena, const std::filesystem::path& folder, Mission& mission);

/// `x`, `y`, `width` and `height`, or for a square `side`.
Rectangle read_rectangle(TableReader& table, bool square);

}  // namespace swarmsmith
