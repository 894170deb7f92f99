#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace swarmsmith {

/// Of the first sample against the second one: it differs, tends to be larger, tends to be smaller.
enum class Alternative { TwoSided, Greater, Less };

/// What R's `wilcox.test` says with its defaults.
struct WilcoxonTest {
  /// Rank-sum: R's W, how many pairs (x, y) have x > y, ties half. Signed-rank: R's V, the sum of
  /// the ranks of positive differences.
  double statistic = 0;
  /// None where R says NaN: there is nothing but ties, or nothing but zero differences.
  std::optional<double> p_value;
  /// From the exact distribution; else by the normal approximation with correction for ties and
  /// continuity.
  bool exact = false;
  std::size_t zeros = 0;  ///< differences of zero, which were dropped; of signed-rank tests alone
  /// The smallest two-sided p that the exact test could give for so many values. Above 0.05 no
  /// difference could be found.
  double least_p = 1;
};

/// Wilcoxon's rank-sum test (Mann and Whitney's U) of two independent samples, neither of them
/// empty. Exact when both have fewer than 50 values and no two values are the same.
/// Source: R 4.2, stats::wilcox.test; Hollander and Wolfe 1973.
WilcoxonTest rank_sum_test(std::span<const double> first, std::span<const double> second,
                           Alternative alternative = Alternative::TwoSided);

/// Wilcoxon's signed-rank test of paired samples of the same length, not empty: their differences
/// first - second, without those that are zero. Exact when fewer than 50 differences remain, none
/// was zero, and no two have the same size.
/// Source: as above.
WilcoxonTest signed_rank_test(std::span<const double> first, std::span<const double> second,
                              Alternative alternative = Alternative::TwoSided);

/// "exact", or "normal approximation, continuity correction".
std::string_view method_of(const WilcoxonTest& test);

}  // namespace swarmsmith
