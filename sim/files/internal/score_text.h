#pragma once

#include <vector>

#include "base/text/toml_text.h"
#include "sim/mission/score.h"

namespace swarmsmith {

/// The lines of [mission.score], which `read_score` reads back to the same rule.
std::vector<SectionLine> score_lines(const ScoreRule& rule);

}  // namespace swarmsmith
