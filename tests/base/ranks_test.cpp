#include "base/ranks.h"

#include <gtest/gtest.h>

#include <bit>
#include <vector>

namespace swarmsmith {
namespace {

/// All choices of m of m + n ranks, one by one.
std::vector<double> counted_rank_sums(std::size_t m, std::size_t n) {
  std::vector<double> counts(m * n + 1);
  for (unsigned chosen = 0; chosen < 1U << (m + n); ++chosen) {
    if (static_cast<std::size_t>(std::popcount(chosen)) != m) continue;
    std::size_t below = 0;
    std::size_t pairs = 0;
    for (std::size_t rank = 0; rank < m + n; ++rank) {
      if ((chosen >> rank & 1U) != 0)
        pairs += below;
      else
        ++below;
    }
    ++counts[pairs];
  }
  return counts;
}

void expect_tails(const std::vector<double>& counts, std::size_t value, const Tails& tails) {
  double all = 0;
  double lower = 0;
  double upper = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    all += counts[i];
    lower += i <= value ? counts[i] : 0;
    upper += i >= value ? counts[i] : 0;
  }
  EXPECT_DOUBLE_EQ(tails.lower, lower / all);
  EXPECT_DOUBLE_EQ(tails.upper, upper / all);
}

TEST(RankDistributions, RankSumsAreThoseOfAllChoices) {
  for (std::size_t m = 1; m <= 6; ++m) {
    for (std::size_t n = 1; n <= 6; ++n) {
      const auto counts = counted_rank_sums(m, n);
      for (std::size_t value = 0; value <= m * n; ++value)
        expect_tails(counts, value, rank_sum_tails(value, m, n));
    }
  }
}

TEST(RankDistributions, SignedRanksAreThoseOfAllSigns) {
  for (std::size_t n = 0; n <= 10; ++n) {
    std::vector<double> counts(n * (n + 1) / 2 + 1);
    for (unsigned positive = 0; positive < 1U << n; ++positive) {
      std::size_t sum = 0;
      for (std::size_t rank = 1; rank <= n; ++rank)
        sum += (positive >> (rank - 1) & 1U) != 0 ? rank : 0;
      ++counts[sum];
    }
    ASSERT_FALSE(counts.empty());
    for (std::size_t value = 0; value < counts.size(); ++value)
      expect_tails(counts, value, signed_rank_tails(value, n));
  }
}

TEST(RankDistributions, SignedRanksOfThreeAreCountedByHand) {
  // Subsets of {1, 2, 3} by their sum 0..6: 1 1 1 2 1 1 1.
  const double eighths[] = {1, 2, 3, 5, 6, 7, 8};
  for (std::size_t v = 0; v <= 6; ++v) {
    EXPECT_EQ(signed_rank_tails(v, 3).lower, eighths[v] / 8);
    EXPECT_EQ(signed_rank_tails(6 - v, 3).upper, eighths[v] / 8);
  }
}

TEST(RankDistributions, SignedRankTailsAddUpToOne) {
  for (std::size_t n = 1; n < 50; ++n) {
    const std::size_t middle = n * (n + 1) / 4;
    EXPECT_EQ(signed_rank_tails(middle, n).lower + signed_rank_tails(middle + 1, n).upper, 1);
  }
}

}  // namespace
}  // namespace swarmsmith
