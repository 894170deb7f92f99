#include "analysis/statistics/wilcoxon.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/math.h"
#include "base/ranks.h"

namespace swarmsmith {
namespace {

/// R computes exact p-values for fewer values than this.
constexpr std::size_t kExactBelow = 50;

double sign_of(double value) {
  return value > 0 ? 1 : (value < 0 ? -1 : 0);
}

/// The normal approximation with continuity correction: the statistic is moved half a step towards
/// its expected value.
std::optional<double> approximate_p(double off, double sd, Alternative alternative) {
  double correction = 0;
  switch (alternative) {
    case Alternative::TwoSided:
      correction = 0.5 * sign_of(off);
      break;
    case Alternative::Greater:
      correction = 0.5;
      break;
    case Alternative::Less:
      correction = -0.5;
      break;
  }
  const double z = (off - correction) / sd;
  if (std::isnan(z)) return std::nullopt;  // 0 / 0: there are only ties
  switch (alternative) {
    case Alternative::Greater:
      return normal_cdf(-z);
    case Alternative::Less:
      return normal_cdf(z);
    case Alternative::TwoSided:
      break;
  }
  return 2 * std::min(normal_cdf(z), normal_cdf(-z));
}

double exact_p(const Tails& tails, Alternative alternative) {
  switch (alternative) {
    case Alternative::Greater:
      return tails.upper;
    case Alternative::Less:
      return tails.lower;
    case Alternative::TwoSided:
      break;
  }
  return std::min(1.0, 2 * std::min(tails.lower, tails.upper));
}

/// 1 divided by (m + n choose m), computed by factors so that large samples give 0.
double one_of_all_choices(std::size_t m, std::size_t n) {
  double part = 1;
  for (std::size_t i = 1; i <= std::min(m, n); ++i)
    part *= static_cast<double>(i) / static_cast<double>(std::max(m, n) + i);
  return part;
}

}  // namespace

WilcoxonTest rank_sum_test(std::span<const double> first, std::span<const double> second,
                           Alternative alternative) {
  std::vector<double> all(first.begin(), first.end());
  all.insert(all.end(), second.begin(), second.end());
  const AverageRanks ranks = average_ranks(all);
  const auto m = static_cast<double>(first.size());
  const auto n = static_cast<double>(second.size());
  WilcoxonTest test;
  for (std::size_t i = 0; i < first.size(); ++i)
    test.statistic += ranks.ranks[i];
  test.statistic -= m * (m + 1) / 2;
  // The clearest case, all values of one sample above all others, is one arrangement in each tail.
  test.least_p = std::min(1.0, 2 * one_of_all_choices(first.size(), second.size()));
  test.exact = first.size() < kExactBelow && second.size() < kExactBelow && ranks.ties == 0;
  if (test.exact) {
    const auto value = static_cast<std::size_t>(test.statistic);
    test.p_value = exact_p(rank_sum_tails(value, first.size(), second.size()), alternative);
  } else {
    // The variance of W without ties, m n (m + n + 1) / 12, becomes smaller by ties.
    const double sd = std::sqrt(m * n / 12 * ((m + n + 1) - ranks.ties / ((m + n) * (m + n - 1))));
    test.p_value = approximate_p(test.statistic - m * n / 2, sd, alternative);
  }
  return test;
}

WilcoxonTest signed_rank_test(std::span<const double> first, std::span<const double> second,
                              Alternative alternative) {
  std::vector<double> differences;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double difference = first[i] - second[i];
    // R drops zeros before it ranks the sizes, and takes the normal approximation if there was one.
    if (difference == 0) continue;
    differences.push_back(difference);
    sizes.push_back(std::abs(difference));
  }
  const AverageRanks ranks = average_ranks(sizes);
  const auto n = static_cast<double>(differences.size());
  WilcoxonTest test{.zeros = first.size() - differences.size()};
  for (std::size_t i = 0; i < differences.size(); ++i) {
    if (differences[i] > 0) test.statistic += ranks.ranks[i];
  }
  // In the clearest case all signs are equal: 2 of 2^n patterns. The zeros do not count in n.
  test.least_p = std::min(1.0, std::exp2(1 - n));
  test.exact = differences.size() < kExactBelow && test.zeros == 0 && ranks.ties == 0;
  if (test.exact) {
    const auto value = static_cast<std::size_t>(test.statistic);
    test.p_value = exact_p(signed_rank_tails(value, differences.size()), alternative);
  } else {
    const double sd = std::sqrt(n * (n + 1) * (2 * n + 1) / 24 - ranks.ties / 48);
    test.p_value = approximate_p(test.statistic - n * (n + 1) / 4, sd, alternative);
  }
  return test;
}

std::string_view method_of(const WilcoxonTest& test) {
  return test.exact ? "exact" : "normal approximation, continuity correction";
}

}  // namespace swarmsmith
