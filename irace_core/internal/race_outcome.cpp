#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/assert.h"
#include "irace_core/internal/race.h"
#include "irace_core/internal/ranking.h"

namespace swarmsmith::irace {

std::vector<std::int64_t> Race::alive_ids() const {
  std::vector<std::int64_t> ids;
  for (const std::size_t c : alive_)
    ids.push_back(contestants_[c].id);
  std::sort(ids.begin(), ids.end());
  return ids;
}

std::vector<RaceStep> Race::take_steps() {
  return std::exchange(steps_, {});
}

/// What an elite knew before is not a result of this race, unless a targetEvaluator gave another
/// cost (irace facts, 18.4).
std::vector<Race::Result> Race::results(std::size_t column) const {
  const std::vector<double>& past = contestants_[column].past;
  const auto first_past = static_cast<std::size_t>(settings_.new_pairs);
  std::vector<Result> results;
  for (std::size_t task = 0; task < costs_[column].size(); ++task) {
    const double cost = costs_[column][task];
    if (std::isnan(cost)) continue;
    const bool is_known = task >= first_past && task - first_past < past.size() &&
                          !std::isnan(past[task - first_past]);
    if (!is_known) {
      SWARMSMITH_ASSERT(task < times_[column].size(), "what was run has a time, if only of 0");
      results.push_back({settings_.pairs[task], cost, times_[column][task], false});
    } else if (cost != past[task - first_past]) {
      results.push_back({settings_.pairs[task], cost, 0, true});
    }
  }
  return results;
}

std::vector<Race::Survivor> Race::survivors() const {
  std::vector<std::size_t> columns;
  std::size_t rows = 0;
  for (const std::size_t c : alive_) {
    const auto known = std::any_of(costs_[c].begin(), costs_[c].end(),
                                   [](double cost) { return !std::isnan(cost); });
    // irace facts, 12: rejections can leave an alive configuration without any result.
    if (!known) continue;
    columns.push_back(c);
    rows = std::max(rows, costs_[c].size());
  }
  std::vector<std::vector<double>> table;
  for (const std::size_t c : columns) {
    table.push_back(costs_[c]);
    // Rows may differ in length: a row grows only when its configuration is run.
    table.back().resize(rows, std::numeric_limits<double>::quiet_NaN());
  }
  // irace facts, 9.4: overall ranks over all rows of the race.
  const std::vector<double> overall = overall_ranks(table, settings_.test_type);
  std::vector<Survivor> survivors;
  for (std::size_t i = 0; i < columns.size(); ++i)
    survivors.push_back({columns[i], overall[i]});
  // Survivors of equal rank keep the order of the race: former elites first, then new ones by id
  // (decision 10).
  std::stable_sort(survivors.begin(), survivors.end(),
                   [](const Survivor& a, const Survivor& b) { return a.rank < b.rank; });
  return survivors;
}

}  // namespace swarmsmith::irace
