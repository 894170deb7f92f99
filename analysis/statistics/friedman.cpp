#include "analysis/statistics/friedman.h"

#include <algorithm>
#include <cmath>

#include "base/ranks.h"
#include "base/special_functions.h"

namespace swarmsmith {
namespace {

/// Sums over the ranks in all blocks.
struct RankSums {
  std::vector<double> of_treatments;  ///< R(j)
  double squares = 0;                 ///< A
  double ties = 0;
};

RankSums rank_sums(const std::vector<std::vector<double>>& values) {
  RankSums sums{.of_treatments = std::vector<double>(values.front().size())};
  for (const std::vector<double>& block : values) {
    std::vector<double> costs(block.size());  // so that the largest value has rank 1
    std::ranges::transform(block, costs.begin(), [](double value) { return -value; });
    const AverageRanks ranks = average_ranks(costs);
    for (std::size_t j = 0; j < block.size(); ++j) {
      sums.of_treatments[j] += ranks.ranks[j];
      sums.squares += ranks.ranks[j] * ranks.ranks[j];
    }
    sums.ties += ranks.ties;
  }
  return sums;
}

}  // namespace

FriedmanTest friedman_test(const std::vector<std::vector<double>>& values) {
  constexpr double kOneTail = 0.025;
  const RankSums sums = rank_sums(values);
  FriedmanTest test{.treatments = values.front().size(), .blocks = values.size()};
  test.degrees = test.treatments - 1;
  const auto b = static_cast<double>(test.blocks);
  const auto k = static_cast<double>(test.treatments);
  double between = 0;
  double squared_sums = 0;
  for (const double sum : sums.of_treatments) {
    const double off = sum - b * (k + 1) / 2;
    between += off * off;
    squared_sums += sum * sum;
    test.mean_ranks.push_back(sum / b);
  }
  // If all values of each block are tied, this is 0 / 0. The result is NaN, as in R.
  test.statistic = 12 * between / (b * k * (k + 1) - sums.ties / (k - 1));
  if (!std::isnan(test.statistic)) {
    test.p_value = chi_square_upper_tail(test.statistic, k - 1);
  }
  if (test.blocks > 1) {
    const double freedom = (b - 1) * (k - 1);
    const double spread = std::max(0.0, 2 * (b * sums.squares - squared_sums) / freedom);
    test.half_width = student_t_upper_quantile(kOneTail, freedom) * std::sqrt(spread) / (2 * b);
  }
  return test;
}

std::optional<FriedmanTest::Interval> FriedmanTest::interval(std::size_t number) const {
  if (!half_width) return std::nullopt;
  const double mean = mean_ranks[number];
  return Interval{std::max(1.0, mean - *half_width),
                  std::min(static_cast<double>(treatments), mean + *half_width)};
}

std::optional<FriedmanTest::Interval> FriedmanTest::told_interval(std::size_t number) const {
  // Ranks are multiples of 1/2, so their sums are exact. The width is exactly 0 if and only if each
  // treatment has the same rank in all blocks. Then any difference of ranks would seem significant.
  if (!finds_a_difference() || !half_width || *half_width == 0) return std::nullopt;
  return interval(number);
}

std::string_view FriedmanTest::reading() const {
  if (!finds_a_difference())
    return "No difference is found at 5 %, so there are no intervals: the order may be chance.";
  if (!told_interval(0))
    return "They differ at 5 %. All blocks have the same order, so there are no intervals to tell "
           "which.";
  return "Intervals of 95 %: two that do not overlap differ at 5 %.";
}

}  // namespace swarmsmith
