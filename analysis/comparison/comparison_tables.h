#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/comparison/comparison.h"

namespace swarmsmith {

/// Tables of a comparison in the format of RFC 4180: header, full precision, missing values are
/// empty. docs/statistics.md lists the columns.
std::string groups_csv(const Comparison& comparison);
std::string pairs_csv(const Comparison& comparison);
std::string ranks_csv(const std::vector<ComparedRanks>& ranks);

/// Names as on the command line: "source", "method", "mission"; "design", "run".
std::string_view name_of(CompareBy by);
std::string_view name_of(ScoreUnit unit);

}  // namespace swarmsmith
