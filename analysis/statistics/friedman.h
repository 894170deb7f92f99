#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace swarmsmith {

/// Friedman's test: do k treatments rank differently over blocks? In each block all treatments were
/// measured.
struct FriedmanTest {
  std::size_t treatments = 0;  ///< k
  std::size_t blocks = 0;      ///< b
  double statistic = 0;        ///< chi-squared, corrected for ties; NaN if all values are tied
  std::size_t degrees = 0;     ///< k - 1
  /// Empty if R returns NaN, because all values within each block are tied.
  std::optional<double> p_value;
  /// Mean rank of each treatment over the blocks; the largest value of a block has rank 1, ties
  /// share their mean rank.
  std::vector<double> mean_ranks;
  /// Half of the smallest difference of two mean ranks that is significant at 5 %: the intervals of
  /// two treatments overlap if their difference is not significant. With r(i,j) the rank of
  /// treatment j in block i, A = sum r(i,j)^2 and R(j) = sum over i,
  ///
  ///   half_width = t(0.975; (b-1)(k-1)) * sqrt(2 (b A - sum R(j)^2) / ((b-1)(k-1))) / (2 b).
  ///
  /// Source: Conover 1999, Practical Nonparametric Statistics, 3rd edition, section 5.8, multiple
  /// comparisons; the form of the intervals is that of the rank plots in AutoMoDe papers. Empty if
  /// there are fewer than two blocks.
  std::optional<double> half_width;

  /// Whether treatments differ at 5 %. If not, no two of them differ, whatever their intervals look
  /// like (Conover, the same section).
  bool finds_a_difference() const { return p_value && *p_value < 0.05; }

  struct Interval {
    double low = 1;
    double high = 1;
  };
  /// The interval of the mean rank of treatment `number`, limited to [1, k]; empty without a half
  /// width.
  std::optional<Interval> interval(std::size_t number) const;
  /// The interval for people: empty if it would claim more than the test.
  std::optional<Interval> told_interval(std::size_t number) const;
  /// A sentence: the meaning of the intervals from `told_interval`, or why there are none.
  std::string_view reading() const;
};

/// `values` has one row per block and one column per treatment, larger is better; at least one row,
/// at least two columns, no NaN. Statistic and p are those of R's `friedman.test`.
FriedmanTest friedman_test(const std::vector<std::vector<double>>& values);

}  // namespace swarmsmith
