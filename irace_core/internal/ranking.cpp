#include "irace_core/internal/ranking.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "irace_core/internal/ranks.h"

namespace swarmsmith::irace {
namespace {

/// Rank sums of the configurations in `group`, by position in it; 1 for a group of one.
std::vector<double> group_ranks(const std::vector<std::vector<double>>& costs,
                                const std::vector<std::size_t>& group) {
  if (group.size() == 1) return {1.0};
  RankTable table(group.size());
  for (std::size_t row = 0; row < costs[group.front()].size(); ++row) {
    std::vector<Entry> entries;
    for (std::size_t i = 0; i < group.size(); ++i) {
      const double cost = costs[group[i]][row];
      if (!std::isnan(cost)) entries.push_back({cost, static_cast<std::uint32_t>(i)});
    }
    if (entries.size() == group.size()) table.add_row(std::move(entries));
  }
  std::vector<double> ranks;
  for (std::size_t i = 0; i < group.size(); ++i)
    ranks.push_back(table.rank_sum(i));
  return ranks;
}

}  // namespace

std::vector<double> overall_ranks(const std::vector<std::vector<double>>& costs) {
  std::map<std::ptrdiff_t, std::vector<std::size_t>, std::greater<>> groups;
  for (std::size_t c = 0; c < costs.size(); ++c) {
    const auto known = std::count_if(costs[c].begin(), costs[c].end(),
                                     [](double cost) { return !std::isnan(cost); });
    groups[known].push_back(c);
  }
  std::vector<double> ranks(costs.size(), 0);
  double shift = 0;
  for (const auto& [known, group] : groups) {
    const std::vector<double> within = group_ranks(costs, group);
    for (std::size_t i = 0; i < group.size(); ++i)
      ranks[group[i]] = shift + within[i];
    shift += *std::max_element(within.begin(), within.end());
  }
  return ranks;
}

}  // namespace swarmsmith::irace
