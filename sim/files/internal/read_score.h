#pragma once

#include <optional>

#include "base/text/table_reader.h"
#include "sim/mission/score.h"

namespace swarmsmith {

/// The [mission.score] table, which replaces the preset's whole score. What is wrong goes to the
/// reader's complaints; nothing when there is no such kind.
std::optional<ScoreRule> read_score(TableReader& score);

}  // namespace swarmsmith
