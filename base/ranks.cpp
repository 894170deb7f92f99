#include "base/ranks.h"

#include <algorithm>
#include <numeric>

namespace swarmsmith {
namespace {

/// The tails from the number of arrangements with each value of the statistic. The distribution is
/// symmetric: each tail is summed from its own end, where small numbers keep their digits.
Tails tails_of(const std::vector<double>& counts, std::size_t value) {
  double all = 0;
  double lower = 0;
  double upper = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    all += counts[i];
    if (i <= value) lower += counts[i];
    if (i + value < counts.size()) upper += counts[i];
  }
  return {lower / all, upper / all};
}

}  // namespace

AverageRanks average_ranks(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
  AverageRanks result{.ranks = std::vector<double>(values.size())};
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() && values[order[end]] == values[order[begin]])
      ++end;
    for (std::size_t i = begin; i < end; ++i)
      result.ranks[order[i]] = static_cast<double>(begin + 1 + end) / 2;
    const auto size = static_cast<double>(end - begin);
    result.ties += size * size * size - size;
    begin = end;
  }
  return result;
}

Tails rank_sum_tails(std::size_t value, std::size_t m, std::size_t n) {
  const std::size_t few = std::min(m, n);
  const std::size_t most = m * n;
  // chosen[j][w]: number of ways to choose j of the ranks so far for the smaller sample such that w
  // pairs have a rank that was not chosen below one that was.
  std::vector<std::vector<double>> chosen(few + 1, std::vector<double>(most + 1));
  chosen[0][0] = 1;
  for (std::size_t rank = 1; rank <= m + n; ++rank) {
    for (std::size_t j = std::min(few, rank); j >= 1; --j) {
      const std::size_t below = rank - j;
      for (std::size_t w = below; w <= most; ++w)
        chosen[j][w] += chosen[j - 1][w - below];
    }
  }
  return tails_of(chosen[few], value);
}

Tails signed_rank_tails(std::size_t value, std::size_t n) {
  std::vector<double> counts(n * (n + 1) / 2 + 1);
  counts[0] = 1;
  for (std::size_t rank = 1; rank <= n; ++rank) {
    for (std::size_t v = counts.size() - 1; v >= rank; --v)
      counts[v] += counts[v - rank];
  }
  return tails_of(counts, value);
}

}  // namespace swarmsmith
