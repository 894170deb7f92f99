#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/special_functions.h"
#include "irace_core/internal/ranks.h"
#include "irace_core/scenario.h"

namespace swarmsmith::irace {

/// The result of an elimination test.
struct TestResult {
  double statistic = 0;
  double p_value = 1;  ///< 0 when decided without a test; NaN when the statistic is undefined;
                       ///< of several tests the smallest, adjusted
  std::vector<std::size_t> dropped;  ///< columns, ascending
};

/// Friedman's test with Conover's multiple comparison on rank sums (irace facts, 10.1), for three
/// or more columns. The best column always survives. `columns` are the columns that take part, in
/// order; of columns with equal rank sums the earlier one comes first.
/// Source: Conover, Practical Nonparametric Statistics, the section on the Friedman test.
TestResult friedman_test(const RankTable& table, std::span<const std::size_t> columns, double alpha,
                         StudentQuantiles& quantiles);

/// The worse of two configurations, and the p-value.
struct PairedResult {
  double statistic = 0;  ///< sum of the ranks of positive differences
  double p_value = 1;
  bool drops_first = false;
  bool drops_second = false;
};

/// Wilcoxon's signed-rank test of two configurations on the same pairs (irace facts, 10.2). A
/// configuration that is never better is dropped without a test; of two equal ones the second is
/// dropped.
PairedResult wilcoxon_test(std::span<const double> first, std::span<const double> second,
                           double alpha);

/// Paired t-tests of each column against the column with the smallest mean (irace facts, 10.3), for
/// two or more columns. `costs[i]` holds the costs of `columns[i]` on the same pairs and `means[i]`
/// their mean; `type` is the adjustment of the p-values. The statistic is the largest |t| of all
/// tests that were made.
TestResult paired_t_tests(std::span<const std::span<const double>> costs,
                          std::span<const double> means, std::span<const std::size_t> columns,
                          double alpha, TestType type);

/// p-values adjusted for this number of simultaneous tests: not at all, or by Bonferroni or Holm (A
/// simple sequentially rejective multiple test procedure, Scandinavian Journal of Statistics 6,
/// 1979).
std::vector<double> adjusted(std::vector<double> p_values, TestType type);

}  // namespace swarmsmith::irace
