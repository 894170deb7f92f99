#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace swarmsmith {

/// Friedman's test: do k treatments rank differently over blocks, where in each block all of them
/// were measured?
struct FriedmanTest {
  std::size_t treatments = 0;  ///< k
  std::size_t blocks = 0;      ///< b
  double statistic = 0;        ///< chi-squared, corrected for ties; NaN when all is tied
  std::size_t degrees = 0;     ///< k - 1
  /// None where R says NaN: every block is tied throughout.
  std::optional<double> p_value;
  /// Of each treatment over the blocks; the largest value of a block has rank 1, ties share theirs.
  std::vector<double> mean_ranks;
  /// Half the least difference of two mean ranks that is significant at 5 %: intervals of two
  /// treatments overlap when their difference is not. With r(i,j) the rank of treatment j in block
  /// i, A = sum r(i,j)^2 and R(j) = sum over i,
  ///
  ///   half_width = t(0.975; (b-1)(k-1)) * sqrt(2 (b A - sum R(j)^2) / ((b-1)(k-1))) / (2 b).
  ///
  /// Source: Conover 1999, Practical Nonparametric Statistics, 3rd edition, section 5.8, multiple
  /// comparisons; the form of the intervals as in the rank plots of AutoMoDe papers. None with
  /// fewer than two blocks.
  std::optional<double> half_width;

  /// Whether treatments differ at 5 %. Without that no two of them differ, whatever their
  /// intervals look like (Conover, the same section).
  bool finds_a_difference() const { return p_value && *p_value < 0.05; }

  struct Interval {
    double low = 1;
    double high = 1;
  };
  /// Of the mean rank of treatment `number`, from 1 to k at most; none without a half width.
  std::optional<Interval> interval(std::size_t number) const;
  /// The same for people: none where it would say more than the test.
  std::optional<Interval> told_interval(std::size_t number) const;
  /// A sentence: what the told intervals say, or why there are none.
  std::string_view reading() const;
};

/// `values` has a row a block and a column a treatment, larger is better; at least one row, at
/// least two columns, no NaN. Statistic and p are those of R's `friedman.test`.
FriedmanTest friedman_test(const std::vector<std::vector<double>>& values);

}  // namespace swarmsmith
