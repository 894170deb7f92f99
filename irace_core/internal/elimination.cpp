#include "irace_core/internal/elimination.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "base/assert.h"
#include "base/math.h"
#include "base/ranks.h"
#include "irace_core/internal/means.h"

namespace swarmsmith::irace {
namespace {

/// The median of all pairwise means (d_a + d_b)/2, a <= b: Hodges and Lehmann's estimate.
double pseudo_median(std::span<const double> differences) {
  SWARMSMITH_ASSERT(!differences.empty(), "a median is of one value or more");
  std::vector<double> means;
  for (std::size_t a = 0; a < differences.size(); ++a) {
    for (std::size_t b = a; b < differences.size(); ++b) {
      means.push_back((differences[a] + differences[b]) / 2);
    }
  }
  std::sort(means.begin(), means.end());
  const std::size_t middle = means.size() / 2;
  return means.size() % 2 == 1 ? means[middle] : (means[middle - 1] + means[middle]) / 2;
}

/// Normal approximation with continuity correction (irace facts, 10.2, step 4): z and s are as
/// defined there, `ties` is the sum(u^3 - u).
double approximate_p(double v, double n, double ties) {
  const double variance = n * (n + 1) * (2 * n + 1) / 24 - ties / 48;
  SWARMSMITH_ASSERT(variance > 0, "the variance is positive, even with tied ranks");
  double z = v - n * (n + 1) / 4;
  const double correction = z > 0 ? 0.5 : (z < 0 ? -0.5 : 0.0);
  z = (z - correction) / std::sqrt(variance);
  return 2 * std::min(normal_cdf(z), normal_cdf(-z));
}

/// Twice the smaller tail of the signed-rank distribution (irace facts, 10.2, step 3).
double exact_p(double v, std::size_t n) {
  const Tails tails = signed_rank_tails(static_cast<std::size_t>(v), n);
  return std::min(1.0, 2 * std::min(tails.lower, tails.upper));
}

/// Like R's all.equal with its default tolerance: relative to the first value, unless that is
/// nearly zero (irace facts, 10.3, step 2).
bool nearly_equal(double first, double second) {
  constexpr double kTolerance = 0x1p-26;
  const double difference = std::fabs(first - second);
  const double size = std::fabs(first);
  return (size > kTolerance ? difference / size : difference) <= kTolerance;
}

/// Whether a column's costs differ at all, which a t-test needs (irace facts, 10.3, step 3).
bool varies(std::span<const double> costs, double mean) {
  constexpr double kLeastVariance = 10 * std::numeric_limits<double>::epsilon();
  return variance_of(costs, mean) >= kLeastVariance;
}

/// Student's |t| = |mean(d)| / sqrt(var(d) / n) of the differences. Nothing if the other column is
/// worse without a test: one of the two does not vary, or the best is at least as good in every
/// row.
std::optional<double> paired_t(std::span<const double> best, double best_mean,
                               std::span<const double> other, double other_mean,
                               std::vector<double>& differences) {
  if (!varies(best, best_mean) || !varies(other, other_mean)) return std::nullopt;
  bool never_worse = true;
  for (std::size_t i = 0; i < best.size(); ++i) {
    differences[i] = best[i] - other[i];
    never_worse = never_worse && differences[i] <= 0;
  }
  if (never_worse) return std::nullopt;
  const double mean = mean_of(differences);
  const double error =
      std::sqrt(variance_of(differences, mean) / static_cast<double>(differences.size()));
  return std::fabs(mean) / error;
}

}  // namespace

TestResult friedman_test(const RankTable& table, std::span<const std::size_t> columns, double alpha,
                         StudentQuantiles& quantiles) {
  SWARMSMITH_ASSERT(columns.size() >= 3, "Friedman's test compares three or more");
  SWARMSMITH_ASSERT(static_cast<std::size_t>(table.columns()) == columns.size(),
                    "ranks are those among the columns that are compared");
  // Step 1 of irace facts, 10.1, was done when the table was filled: R_j are its rank sums.
  const auto n = static_cast<double>(table.rows());
  const auto k = static_cast<double>(columns.size());
  double spread = 0;
  double square_sums = 0;
  double rank_sums = 0;
  for (const std::size_t column : columns) {
    const double sum = table.rank_sum(column);
    rank_sums += sum;
    spread += (sum - n * (k + 1) / 2) * (sum - n * (k + 1) / 2);
    square_sums += sum * sum;
  }
  // Average ranks are multiples of 1/2, so that these sums are exact.
  SWARMSMITH_ASSERT(rank_sums == n * k * (k + 1) / 2, "the ranks of a row are 1 to k, or shared");
  // Step 2: S. Ties are subtracted, since tied ranks vary less than different ones.
  TestResult result;
  result.statistic = 12 * spread / (n * k * (k + 1) - table.ties() / (k - 1));
  if (std::isnan(result.statistic)) {  // 0/0: all rows are tied throughout
    result.p_value = std::numeric_limits<double>::quiet_NaN();
    return result;
  }
  SWARMSMITH_ASSERT(result.statistic >= 0, "a sum of squares is not negative");
  // Step 3: S against chi-square with k - 1 degrees of freedom.
  result.p_value = chi_square_upper_tail(result.statistic, k - 1);
  // With a single pair there is no degree of freedom for comparing columns.
  if (!(result.p_value < alpha) || table.rows() < 2) return result;

  // Step 4: f and D. Rounding can make the difference negative when the rows agree completely.
  const double dof = (n - 1) * (k - 1);
  const double scatter = std::max(0.0, 2 * (n * table.squares() - square_sums) / dof);
  const double difference = quantiles(static_cast<std::int64_t>(dof)) * std::sqrt(scatter);
  // Step 5. The smallest R_j differs from itself by 0, and D is never negative, so the best
  // survives.
  double best = table.rank_sum(columns.front());
  for (const std::size_t column : columns)
    best = std::min(best, table.rank_sum(column));
  for (const std::size_t column : columns) {
    if (std::fabs(table.rank_sum(column) - best) > difference) result.dropped.push_back(column);
  }
  SWARMSMITH_ASSERT(result.dropped.size() < columns.size(), "the best column survives");
  return result;
}

PairedResult wilcoxon_test(std::span<const double> first, std::span<const double> second,
                           double alpha) {
  SWARMSMITH_ASSERT(first.size() == second.size(), "both have the same number of costs");
  std::vector<double> differences;
  bool never_worse = true;
  bool never_better = true;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double difference = first[i] - second[i];
    never_worse = never_worse && difference <= 0;
    never_better = never_better && difference >= 0;
    if (difference != 0) differences.push_back(difference);
  }
  // Step 1 of irace facts, 10.2: of two equal columns the second is dropped.
  if (never_worse) return {0, 0, false, true};
  if (never_better) return {0, 0, true, false};

  // Step 2: V over the differences that are not zero.
  std::vector<double> magnitudes;
  magnitudes.reserve(differences.size());
  for (const double difference : differences)
    magnitudes.push_back(std::fabs(difference));
  const AverageRanks ranked = average_ranks(magnitudes);
  PairedResult result;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    if (differences[i] > 0) result.statistic += ranked.ranks[i];
  }
  // Steps 3 and 4: the exact distribution holds only without zeros and ties, and is used for small
  // n.
  const bool clean = differences.size() == first.size() && ranked.ties == 0;
  const std::size_t n = differences.size();
  result.p_value = clean && n < 50
                       ? exact_p(result.statistic, n)
                       : approximate_p(result.statistic, static_cast<double>(n), ranked.ties);
  if (!(result.p_value < alpha)) return result;
  // Step 5.
  const bool first_is_better = pseudo_median(differences) <= 0;
  result.drops_first = !first_is_better;
  result.drops_second = first_is_better;
  return result;
}

std::vector<double> adjusted(std::vector<double> p_values, TestType type) {
  const std::size_t k = p_values.size();
  if (type == TestType::TTestBonferroni) {
    for (double& p : p_values)
      p = std::min(1.0, static_cast<double>(k) * p);
  }
  if (type == TestType::TTestHolm) {
    // Step-down: the i-th smallest of k is multiplied by k - i + 1, and is at least as large as
    // those before it, so that a larger p is never significant when a smaller one is not.
    std::vector<std::size_t> order(k);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });
    double largest = 0;
    for (std::size_t i = 0; i < k; ++i) {
      double& p = p_values[order[i]];
      largest = std::max(largest, std::min(1.0, static_cast<double>(k - i) * p));
      p = largest;
    }
  }
  return p_values;
}

TestResult paired_t_tests(std::span<const std::span<const double>> costs,
                          std::span<const double> means, std::span<const std::size_t> columns,
                          double alpha, TestType type) {
  SWARMSMITH_ASSERT(columns.size() >= 2 && costs.size() == columns.size(), "columns to compare");
  SWARMSMITH_ASSERT(means.size() == columns.size(), "each column has its mean");
  // Step 1 of irace facts, 10.3. The best column's own p stays 1, so that no adjustment drops it.
  const auto best =
      static_cast<std::size_t>(std::min_element(means.begin(), means.end()) - means.begin());
  const std::size_t rows = costs[best].size();
  std::vector<double> differences(rows);
  std::vector<double> p_values(columns.size(), 1);
  TestResult result;
  for (std::size_t i = 0; i < columns.size(); ++i) {  // steps 2 and 3
    if (nearly_equal(means[best], means[i])) continue;
    SWARMSMITH_ASSERT(costs[i].size() == rows, "all have the same pairs");
    const std::optional<double> t =
        paired_t(costs[best], means[best], costs[i], means[i], differences);
    p_values[i] = t ? student_t_two_sided_tail(*t, static_cast<double>(rows) - 1) : 0;
    result.statistic = std::max(result.statistic, t.value_or(0));
  }
  // Steps 4 and 5.
  p_values = adjusted(std::move(p_values), type);
  result.p_value = *std::min_element(p_values.begin(), p_values.end());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (p_values[i] < alpha) result.dropped.push_back(columns[i]);
  }
  return result;
}

}  // namespace swarmsmith::irace
