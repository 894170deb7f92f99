#include "benchmarks/colony/rank_sum.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/math.h"

namespace swarmsmith {
namespace {

/// How many of the orders of n and m values have each U = 0, ..., n m; as fractions of all. Counts
/// grow from n and m one smaller: the largest value belongs to one sample or the other.
std::vector<double> distribution_of_u(std::size_t n, std::size_t m) {
  // by_m[j] is the distribution for (i, j), i as far as the loop is.
  std::vector<std::vector<double>> by_m(m + 1, std::vector<double>{1});
  for (std::size_t i = 1; i <= n; ++i) {
    std::vector<std::vector<double>> next(m + 1);
    next[0] = {1};
    for (std::size_t j = 1; j <= m; ++j) {
      next[j].assign(i * j + 1, 0);
      const double of_a = static_cast<double>(i) / static_cast<double>(i + j);
      for (std::size_t u = 0; u < by_m[j].size(); ++u)
        next[j][u + j] += of_a * by_m[j][u];
      for (std::size_t u = 0; u < next[j - 1].size(); ++u)
        next[j][u] += (1 - of_a) * next[j - 1][u];
    }
    by_m = std::move(next);
  }
  return by_m[m];
}

}  // namespace

double p_of_larger(std::span<const double> a, std::span<const double> b) {
  double u = 0;  // pairs in which a is larger, half of those that are equal
  for (const double x : a) {
    for (const double y : b)
      u += x > y ? 1 : (x == y ? 0.5 : 0);
  }
  std::vector<double> all(a.begin(), a.end());
  all.insert(all.end(), b.begin(), b.end());
  std::ranges::sort(all);
  double ties = 0;
  for (std::size_t i = 0, end = 0; i < all.size(); i = end) {
    while (end < all.size() && all[end] == all[i])
      ++end;
    const auto size = static_cast<double>(end - i);
    ties += size * size * size - size;
  }
  const auto n = static_cast<double>(a.size());
  const auto m = static_cast<double>(b.size());
  if (ties == 0) {
    const std::vector<double> distribution = distribution_of_u(a.size(), b.size());
    double p = 0;
    for (auto i = static_cast<std::size_t>(u); i < distribution.size(); ++i)
      p += distribution[i];
    return std::min(p, 1.0);
  }
  const double variance = n * m / 12 * (n + m + 1 - ties / ((n + m) * (n + m - 1)));
  if (variance == 0) return 1;
  return normal_cdf(-(u - n * m / 2 - 0.5) / std::sqrt(variance));
}

}  // namespace swarmsmith
