#pragma once

#include <string>

#include "analysis/records/chosen_scores.h"
#include "analysis/report/html.h"

namespace swarmsmith {

/// A row a mission, method, source and purpose: number, mean, standard deviation, and the five
/// numbers of a box plot (analysis/statistics/summary.h).
HtmlTable score_table(const std::string& caption, const ChosenScores& taken);

}  // namespace swarmsmith
