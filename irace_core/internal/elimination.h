#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "irace_core/internal/ranks.h"
#include "irace_core/internal/special_functions.h"

namespace swarmsmith::irace {

/// What an elimination test found.
struct TestResult {
  double statistic = 0;
  double p_value = 1;  ///< 0 when decided without a test; NaN when the statistic is undefined
  std::vector<std::size_t> dropped;  ///< columns, ascending
};

/// Friedman's test with Conover's multiple comparison on rank sums (irace facts, 10.1): three
/// columns or more. The best column always survives. `columns` are those that take part, in
/// order; of columns with equal rank sums the earlier one comes first.
/// Source: Conover, Practical Nonparametric Statistics, the section on the Friedman test.
TestResult friedman_test(const RankTable& table, std::span<const std::size_t> columns, double alpha,
                         StudentQuantiles& quantiles);

/// Which of two is worse, and how sure that is.
struct PairedResult {
  double statistic = 0;  ///< sum of the ranks of positive differences
  double p_value = 1;
  bool drops_first = false;
  bool drops_second = false;
};

/// Wilcoxon's signed-rank test of two configurations on the same pairs (irace facts, 10.2). One
/// that is never better is dropped without a test; of two equal ones the second.
PairedResult wilcoxon_test(std::span<const double> first, std::span<const double> second,
                           double alpha);

}  // namespace swarmsmith::irace
