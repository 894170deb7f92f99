#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace swarmsmith {

/// Ranks of values, the smallest has 1 and ties share their mean rank.
struct AverageRanks {
  std::vector<double> ranks;
  double ties = 0;  ///< sum of u^3 - u over the sizes u of the groups of equal values
};

AverageRanks average_ranks(std::span<const double> values);

/// Distributions of Wilcoxon's statistics without ties when nothing differs, by counting: R's
/// pwilcox and psignrank.

/// The two tails at a value that the statistic can have.
struct Tails {
  double lower = 1;  ///< P(statistic <= value)
  double upper = 1;  ///< P(statistic >= value)
};

/// Of W, how many of the m n pairs have x > y; both below 50.
Tails rank_sum_tails(std::size_t value, std::size_t m, std::size_t n);

/// Of V, the sum of the ranks of positive differences among n; n below 50.
Tails signed_rank_tails(std::size_t value, std::size_t n);

}  // namespace swarmsmith
