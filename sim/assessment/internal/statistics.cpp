#include "sim/assessment/internal/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace swarmsmith::assessment {

Interval wilson_interval(std::int64_t hits, std::int64_t trials) {
  if (trials == 0) return {};
  constexpr double kZ = 2.5758293035489004;  // two-sided 99 % point of the normal distribution
  constexpr double kZ2 = kZ * kZ;
  const auto n = static_cast<double>(trials);
  const double rate = static_cast<double>(hits) / n;
  const double centre = (rate + kZ2 / (2 * n)) / (1 + kZ2 / n);
  const double half = kZ / (1 + kZ2 / n) * std::sqrt(rate * (1 - rate) / n + kZ2 / (4 * n * n));
  return {std::max(0.0, centre - half), std::min(1.0, centre + half)};
}

double geometric_chi_square(std::span<const double> waits) {
  // P(wait = n) = 2^-n for n = 1 to 3; the last cell has all longer waits.
  constexpr std::array<double, 4> kShares = {0.5, 0.25, 0.125, 0.125};
  std::array<double, 4> counts{};
  for (const double wait : waits) {
    const auto cell = static_cast<std::size_t>(std::clamp(wait, 1.0, 4.0)) - 1;
    ++counts[cell];
  }
  double sum = 0;
  for (std::size_t cell = 0; cell < counts.size(); ++cell) {
    const double expected = kShares[cell] * static_cast<double>(waits.size());
    sum += (counts[cell] - expected) * (counts[cell] - expected) / expected;
  }
  return sum;
}

}  // namespace swarmsmith::assessment
