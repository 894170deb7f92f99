#include "irace_core/internal/elimination.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/assert.h"
#include "base/math.h"

namespace swarmsmith::irace {
namespace {

/// The median of all pairwise means (d_a + d_b)/2, a <= b: Hodges and Lehmann's estimate.
double pseudo_median(std::span<const double> differences) {
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

/// Normal approximation with continuity correction.
double approximate_p(double v, double n, double ties) {
  const double variance = n * (n + 1) * (2 * n + 1) / 24 - ties / 48;
  double z = v - n * (n + 1) / 4;
  const double correction = z > 0 ? 0.5 : (z < 0 ? -0.5 : 0.0);
  z = (z - correction) / std::sqrt(variance);
  return 2 * std::min(normal_cdf(z), normal_cdf(-z));
}

double exact_p(double v, int n) {
  const auto sum = static_cast<std::int64_t>(v);
  const double tail =
      v > n * (n + 1) / 4.0 ? signed_rank_upper_tail(sum, n) : signed_rank_lower_tail(sum, n);
  return std::min(1.0, 2 * tail);
}

}  // namespace

TestResult friedman_test(const RankTable& table, std::span<const std::size_t> columns, double alpha,
                         StudentQuantiles& quantiles) {
  SWARMSMITH_ASSERT(columns.size() >= 3, "Friedman's test compares three or more");
  const auto n = static_cast<double>(table.rows());
  const auto k = static_cast<double>(columns.size());
  double spread = 0;
  double square_sums = 0;
  for (const std::size_t column : columns) {
    const double sum = table.rank_sum(column);
    spread += (sum - n * (k + 1) / 2) * (sum - n * (k + 1) / 2);
    square_sums += sum * sum;
  }
  TestResult result;
  result.statistic = 12 * spread / (n * k * (k + 1) - table.ties() / (k - 1));
  if (std::isnan(result.statistic)) {
    result.p_value = std::numeric_limits<double>::quiet_NaN();
    return result;
  }
  result.p_value = chi_square_upper_tail(result.statistic, k - 1);
  if (!(result.p_value < alpha)) return result;

  const double dof = (n - 1) * (k - 1);
  const double scatter = std::max(0.0, 2 * (n * table.squares() - square_sums) / dof);
  const double difference = quantiles(static_cast<std::int64_t>(dof)) * std::sqrt(scatter);
  double best = table.rank_sum(columns.front());
  for (const std::size_t column : columns)
    best = std::min(best, table.rank_sum(column));
  for (const std::size_t column : columns) {
    if (std::fabs(table.rank_sum(column) - best) > difference) result.dropped.push_back(column);
  }
  return result;
}

PairedResult wilcoxon_test(std::span<const double> first, std::span<const double> second,
                           double alpha) {
  SWARMSMITH_ASSERT(first.size() == second.size(), "costs come in pairs");
  std::vector<double> differences;
  bool never_worse = true;
  bool never_better = true;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double difference = first[i] - second[i];
    never_worse = never_worse && difference <= 0;
    never_better = never_better && difference >= 0;
    if (difference != 0) differences.push_back(difference);
  }
  if (never_worse) return {0, 0, false, true};
  if (never_better) return {0, 0, true, false};

  std::vector<double> magnitudes;
  for (const double difference : differences)
    magnitudes.push_back(std::fabs(difference));
  const AverageRanks ranked = average_ranks(magnitudes);
  PairedResult result;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    if (differences[i] > 0) result.statistic += ranked.ranks[i];
  }
  const bool clean = differences.size() == first.size() && ranked.ties == 0;
  const auto n = static_cast<int>(differences.size());
  result.p_value = clean && n < 50 ? exact_p(result.statistic, n)
                                   : approximate_p(result.statistic, n, ranked.ties);
  if (!(result.p_value < alpha)) return result;
  const bool first_is_better = pseudo_median(differences) <= 0;
  result.drops_first = !first_is_better;
  result.drops_second = first_is_better;
  return result;
}

}  // namespace swarmsmith::irace
