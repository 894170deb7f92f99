#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace swarmsmith {

/// Ranks of values: the smallest value has rank 1, and equal values share their mean rank.
struct AverageRanks {
  std::vector<double> ranks;
  double ties = 0;  ///< sum of u^3 - u over the sizes u of the groups of equal values
};

AverageRanks average_ranks(std::span<const double> values);

/// Exact distributions of Wilcoxon's statistics without ties under the null hypothesis, by
/// counting: R's pwilcox and psignrank.

/// The two tails at a possible value of the statistic.
struct Tails {
  double lower = 1;  ///< P(statistic <= value)
  double upper = 1;  ///< P(statistic >= value)
};

/// The tails of W, the number of the m n pairs with x > y; both m and n below 50.
Tails rank_sum_tails(std::size_t value, std::size_t m, std::size_t n);

/// The tails of V, the sum of the ranks of positive differences among n; n below 50.
Tails signed_rank_tails(std::size_t value, std::size_t n);

}  // namespace swarmsmith
