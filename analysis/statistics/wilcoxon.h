#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace swarmsmith {

/// The significance level of all tests: a smaller p is a difference.
inline constexpr double kTestLevel = 0.05;

/// The alternative about the first sample compared with the second one: it differs, tends to be
/// larger, tends to be smaller.
enum class Alternative { TwoSided, Greater, Less };

/// The result of R's `wilcox.test` with its defaults.
struct WilcoxonTest {
  /// Rank-sum test: R's W, the number of pairs (x, y) with x > y; ties count half. Signed-rank
  /// test: R's V, the sum of the ranks of positive differences.
  double statistic = 0;
  /// Empty if R returns NaN, because there are only ties, or only differences of zero.
  std::optional<double> p_value;
  /// From the exact distribution; else by the normal approximation with correction for ties and
  /// continuity.
  bool exact = false;
  std::size_t zeros = 0;  ///< number of dropped zero differences; only for signed-rank tests
  /// The smallest two-sided p that the exact test could give for this number of values. No
  /// difference can be found unless it is below `kTestLevel`.
  double least_p = 1;
};

/// Wilcoxon's rank-sum test (Mann and Whitney's U) for two independent samples, neither empty.
/// Exact if both have fewer than 50 values and no two values are equal.
/// Source: R 4.2, stats::wilcox.test; Hollander and Wolfe 1973.
WilcoxonTest rank_sum_test(std::span<const double> first, std::span<const double> second,
                           Alternative alternative = Alternative::TwoSided);

/// Wilcoxon's signed-rank test for paired samples of the same length, not empty: uses the
/// differences first - second, without zeros. Exact if fewer than 50 differences remain, none was
/// zero, and no two have the same absolute value.
/// Source: as above.
WilcoxonTest signed_rank_test(std::span<const double> first, std::span<const double> second,
                              Alternative alternative = Alternative::TwoSided);

/// "exact", or "normal approximation, continuity correction".
std::string_view method_of(const WilcoxonTest& test);

}  // namespace swarmsmith
