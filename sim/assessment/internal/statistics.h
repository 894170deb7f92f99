#pragma once

#include <cstdint>
#include <span>

namespace swarmsmith::assessment {

struct Interval {
  double low = 0;
  double high = 1;
};

/// Wilson's score interval of a rate, 99 %; [0, 1] without trials (Wilson, JASA 22, 1927).
Interval wilson_interval(std::int64_t hits, std::int64_t trials);

/// Chi-square statistic of waiting times against the geometric distribution with probability one
/// half; the classes are 1, 2, 3, and 4 or more trials: 3 degrees of freedom.
double geometric_chi_square(std::span<const double> waits);

/// The upper 1 % point of its distribution.
inline constexpr double kChiSquare3At1Percent = 11.344866730144373;

}  // namespace swarmsmith::assessment
