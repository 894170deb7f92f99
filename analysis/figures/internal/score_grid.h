#pragma once

#include <string>
#include <vector>

#include "analysis/figures/score_distribution.h"

namespace swarmsmith {

/// Histograms of many groups on one page: a row per method, a column per mission, and a colour per
/// source, given by its index in `sources`.
std::string draw_score_grid(const ScoreDistribution& plot, const std::vector<std::string>& sources);

}  // namespace swarmsmith
