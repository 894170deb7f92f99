#pragma once

#include <span>
#include <vector>

namespace swarmsmith {

/// Ranks of values, the smallest has 1 and ties share their mean rank.
struct AverageRanks {
  std::vector<double> ranks;
  double ties = 0;  ///< sum of u^3 - u over the sizes u of the groups of equal values
};

AverageRanks average_ranks(std::span<const double> values);

}  // namespace swarmsmith
