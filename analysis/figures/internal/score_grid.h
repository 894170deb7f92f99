#pragma once

#include <string>
#include <vector>

#include "analysis/figures/score_distribution.h"

namespace swarmsmith {

/// Histograms of many groups on a page: a row a method, a column a mission, a colour a source,
/// whose number among `sources` it is.
std::string draw_score_grid(const ScoreDistribution& plot, const std::vector<std::string>& sources);

}  // namespace swarmsmith
