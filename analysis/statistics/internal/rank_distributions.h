#pragma once

#include <cstddef>

namespace swarmsmith {

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
