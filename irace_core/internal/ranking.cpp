#include "irace_core/internal/ranking.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "base/ranks.h"
#include "irace_core/internal/means.h"
#include "irace_core/internal/ranks.h"

namespace swarmsmith::irace {
namespace {

using Group = std::vector<std::size_t>;

/// The rows on which all configurations of `group` were tried.
std::vector<std::size_t> common_rows(const std::vector<std::vector<double>>& costs,
                                     const Group& group) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < costs[group.front()].size(); ++row) {
    if (std::none_of(group.begin(), group.end(),
                     [&](std::size_t c) { return std::isnan(costs[c][row]); })) {
      rows.push_back(row);
    }
  }
  return rows;
}

/// irace facts, 11, F-test: in each row the average ranks of the group, summed over the rows.
std::vector<double> rank_sums(const std::vector<std::vector<double>>& costs, const Group& group,
                              const std::vector<std::size_t>& rows) {
  RankTable table(group.size());
  for (const std::size_t row : rows) {
    std::vector<Entry> entries;
    entries.reserve(group.size());
    for (std::size_t i = 0; i < group.size(); ++i) {
      entries.push_back({costs[group[i]][row], static_cast<std::uint32_t>(i)});
    }
    table.add_row(std::move(entries));
  }
  std::vector<double> sums;
  for (std::size_t i = 0; i < group.size(); ++i)
    sums.push_back(table.rank_sum(i));
  return sums;
}

/// irace facts, 11, t-tests. mean_of() carries rounding errors along, so that equal values have
/// equal means, as in R.
std::vector<double> ranks_of_means(const std::vector<std::vector<double>>& costs,
                                   const Group& group, const std::vector<std::size_t>& rows) {
  std::vector<double> means(group.size(), 0);
  for (std::size_t i = 0; i < group.size() && !rows.empty(); ++i) {
    std::vector<double> values;
    values.reserve(rows.size());
    for (const std::size_t row : rows)
      values.push_back(costs[group[i]][row]);
    means[i] = mean_of(values);
  }
  return average_ranks(means).ranks;
}

/// The ranks by position in the group; 1 in a group of one.
std::vector<double> group_ranks(const std::vector<std::vector<double>>& costs, const Group& group,
                                TestType type) {
  if (group.size() == 1) return {1.0};
  const std::vector<std::size_t> rows = common_rows(costs, group);
  return type == TestType::FTest ? rank_sums(costs, group, rows)
                                 : ranks_of_means(costs, group, rows);
}

}  // namespace

std::vector<double> overall_ranks(const std::vector<std::vector<double>>& costs, TestType type) {
  // More pairs first: a configuration that was dropped early has seen fewer, so its ranks cannot be
  // compared with those of a survivor.
  std::map<std::ptrdiff_t, Group, std::greater<>> groups;
  for (std::size_t c = 0; c < costs.size(); ++c) {
    const auto known = std::count_if(costs[c].begin(), costs[c].end(),
                                     [](double cost) { return !std::isnan(cost); });
    groups[known].push_back(c);
  }
  std::vector<double> ranks(costs.size(), 0);
  double shift = 0;
  for (const auto& [known, group] : groups) {
    const std::vector<double> within = group_ranks(costs, group, type);
    for (std::size_t i = 0; i < group.size(); ++i)
      ranks[group[i]] = shift + within[i];
    // irace facts, 11: the largest rank of a group is added to all ranks of the next one.
    shift += *std::max_element(within.begin(), within.end());
  }
  return ranks;
}

}  // namespace swarmsmith::irace
