#pragma once

#include <span>
#include <string>

#include "analysis/records/records.h"
#include "analysis/report/html.h"

namespace swarmsmith {

/// What a row of a table of scores is of: all designs of a mission and method, or one design; each
/// by source and purpose.
enum class ScoreGroups { OfMethods, OfDesigns };

/// Number, mean, standard deviation, and the five numbers of a box plot
/// (analysis/statistics/summary.h).
HtmlTable score_table(const std::string& caption, std::span<const DesignScore> scores,
                      ScoreGroups groups);

}  // namespace swarmsmith
