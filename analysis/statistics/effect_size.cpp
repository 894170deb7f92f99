#include "analysis/statistics/effect_size.h"

#include <cmath>
#include <vector>

#include "base/ranks.h"

namespace swarmsmith {

double vargha_delaney(std::span<const double> first, std::span<const double> second) {
  std::vector<double> all(first.begin(), first.end());
  all.insert(all.end(), second.begin(), second.end());
  const AverageRanks ranks = average_ranks(all);
  const auto m = static_cast<double>(first.size());
  const auto n = static_cast<double>(second.size());
  double sum = 0;
  for (std::size_t i = 0; i < first.size(); ++i)
    sum += ranks.ranks[i];
  // The authors' (R1 / m - (m + 1) / 2) / n, where R1 is the rank sum of the first sample.
  return (sum - m * (m + 1) / 2) / (m * n);
}

std::string_view magnitude_of(double a12) {
  // 0.71 - 0.5 is slightly less than 0.21 in binary; a value on a bound counts as the larger
  // effect.
  constexpr double kRounding = 1e-12;
  const double off = std::abs(a12 - 0.5) + kRounding;
  if (off >= 0.21) return "large";
  if (off >= 0.14) return "medium";
  if (off >= 0.06) return "small";
  return "negligible";
}

}  // namespace swarmsmith
