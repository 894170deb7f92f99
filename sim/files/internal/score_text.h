#pragma once

#include <vector>

#include "sim/files/toml_text.h"
#include "sim/mission/score.h"

namespace swarmsmith {

/// The lines of [mission.score].
std::vector<SectionLine> score_lines(const ScoreRule& rule);

}  // namespace swarmsmith
