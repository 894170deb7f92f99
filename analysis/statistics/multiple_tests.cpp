#include "analysis/statistics/multiple_tests.h"

#include <algorithm>
#include <cstddef>

namespace swarmsmith {

std::vector<std::optional<double>> holm_adjusted(std::span<const std::optional<double>> p_values) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < p_values.size(); ++i) {
    if (p_values[i]) order.push_back(i);
  }
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return *p_values[i]; });
  std::vector<std::optional<double>> adjusted(p_values.size());
  double least = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    // The number of tests is that of the p-values that exist, as in R's `p.adjust` with NA. The
    // maximum keeps the order of the p-values.
    least = std::max(least, static_cast<double>(order.size() - i) * *p_values[order[i]]);
    adjusted[order[i]] = std::min(1.0, least);
  }
  return adjusted;
}

}  // namespace swarmsmith
