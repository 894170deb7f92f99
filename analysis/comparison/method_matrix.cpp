#include "analysis/comparison/method_matrix.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "analysis/comparison/comparison_tables.h"
#include "analysis/statistics/multiple_tests.h"
#include "base/ranks.h"

namespace swarmsmith {
namespace {

/// The methods of a mission and source, best mean first.
using Groups = std::vector<const ComparedGroup*>;

/// Holm's p for each pair of groups; empty if a test has no p.
using PairValues = std::vector<std::vector<std::optional<double>>>;

Groups groups_of(const Comparison& comparison, const std::string& mission,
                 const std::string& source) {
  Groups groups;
  for (const ComparedGroup& group : comparison.groups) {
    if (group.mission == mission && group.source == source) groups.push_back(&group);
  }
  std::ranges::stable_sort(groups, std::greater(),
                           [](const ComparedGroup* group) { return group->summary.mean; });
  return groups;
}

PairValues tested(const Comparison& comparison, const Groups& groups) {
  PairValues result(groups.size(), std::vector<std::optional<double>>(groups.size()));
  if (groups.empty()) return result;
  std::vector<std::pair<std::size_t, std::size_t>> places;
  std::vector<std::optional<double>> p_values;
  const auto place_of = [&](const std::string& method) {
    return static_cast<std::size_t>(
        std::ranges::find(groups, method,
                          [](const ComparedGroup* group) { return group->method; }) -
        groups.begin());
  };
  for (const ComparedPair& pair : comparison.pairs) {
    if (pair.mission != groups.front()->mission || pair.source != groups.front()->source) continue;
    places.emplace_back(place_of(pair.first), place_of(pair.second));
    p_values.push_back(pair.test.p_value);
  }
  // Holm's correction is over the pairs of this mission and source only; `ComparedPair::p_holm` is
  // over all pairs of the comparison (docs/statistics.md, "Methods by missions").
  const auto adjusted = holm_adjusted(p_values);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto [a, b] = places[i];
    result[a][b] = result[b][a] = adjusted[i];
  }
  return result;
}

std::optional<double> half_width_of(const std::vector<double>& values) {
  if (values.size() < 2) return std::nullopt;
  return mean_interval(values).half_width;
}

/// The cells of a mission, in the order of its groups.
std::vector<MethodMatrix::Cell> cells_of(const Comparison& comparison, const Groups& groups) {
  const PairValues p_values = tested(comparison, groups);
  std::vector<std::vector<bool>> different(groups.size(), std::vector<bool>(groups.size()));
  std::vector<double> costs;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    costs.push_back(-groups[i]->summary.mean);
    for (std::size_t j = 0; j < groups.size(); ++j)
      // A test without a p, because all values are the same, finds no difference.
      different[i][j] = p_values[i][j] && *p_values[i][j] < kTestLevel;
  }
  const auto letters = letters_of(different);
  const AverageRanks ranks = average_ranks(costs);
  std::vector<MethodMatrix::Cell> cells;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const ComparedGroup& group = *groups[i];
    cells.push_back({.n = group.values.size(),
                     .runs = group.runs,
                     .mean = group.summary.mean,
                     .half_width = half_width_of(group.values),
                     .rank = ranks.ranks[i],
                     .letters = groups.size() > 1 ? letters[i] : "",
                     .behind = groups.front()->summary.mean - group.summary.mean,
                     .p_behind = p_values[0][i]});
  }
  return cells;
}

void rank_rows(MethodMatrix& matrix) {
  for (MethodMatrix::Row& row : matrix.rows) {
    double sum = 0;
    for (const auto& cell : row.cells)
      sum += cell ? cell->rank : std::numeric_limits<double>::quiet_NaN();
    // NaN, from a mission without this method, fails this comparison: mean ranks over different
    // missions cannot be compared.
    if (sum > 0) row.mean_rank = sum / static_cast<double>(row.cells.size());
  }
  std::ranges::stable_sort(matrix.rows, {}, [](const MethodMatrix::Row& row) {
    return std::pair(row.mean_rank.value_or(std::numeric_limits<double>::max()), row.method);
  });
}

MethodMatrix matrix_of(const Comparison& comparison, const std::string& source) {
  MethodMatrix matrix{.source = source};
  std::set<std::string> missions;
  std::set<std::string> methods;
  for (const ComparedGroup& group : comparison.groups) {
    if (group.source != source) continue;
    missions.insert(group.mission);
    methods.insert(group.method);
  }
  matrix.missions.assign(missions.begin(), missions.end());
  for (const std::string& method : methods)
    matrix.rows.push_back(
        {.method = method,
         .mean_rank = {},
         .cells = std::vector<std::optional<MethodMatrix::Cell>>(missions.size())});
  for (std::size_t m = 0; m < matrix.missions.size(); ++m) {
    const Groups groups = groups_of(comparison, matrix.missions[m], source);
    const auto cells = cells_of(comparison, groups);
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const auto row =
          std::ranges::find(matrix.rows, groups[i]->method, &MethodMatrix::Row::method);
      row->cells[m] = cells[i];
    }
  }
  rank_rows(matrix);
  return matrix;
}

/// Whether all of `a` is in `b`.
bool is_within(const std::set<std::size_t>& a, const std::set<std::size_t>& b) {
  return std::ranges::includes(b, a);
}

/// a, b, ..., z, a2, b2, ...
std::string letter(std::size_t number) {
  std::string text(1, static_cast<char>('a' + number % 26));
  return number < 26 ? text : text + std::to_string(number / 26 + 1);
}

}  // namespace

std::vector<std::string> letters_of(const std::vector<std::vector<bool>>& different) {
  std::vector<std::set<std::size_t>> columns(1);
  for (std::size_t i = 0; i < different.size(); ++i)
    columns.front().insert(i);
  for (std::size_t i = 0; i < different.size(); ++i) {
    for (std::size_t j = i + 1; j < different.size(); ++j) {
      if (!different[i][j]) continue;
      std::vector<std::set<std::size_t>> split;
      for (const auto& column : columns) {
        if (!column.contains(i) || !column.contains(j)) {
          split.push_back(column);
          continue;
        }
        // Insert: a column with both items becomes two columns, each without one of them.
        for (const std::size_t left_out : {i, j}) {
          split.push_back(column);
          split.back().erase(left_out);
        }
      }
      // A column that is contained in another one is not needed.
      columns.clear();
      for (std::size_t a = 0; a < split.size(); ++a) {
        bool is_needed = true;
        for (std::size_t b = 0; b < split.size() && is_needed; ++b) {
          const bool is_same = split[a] == split[b];
          is_needed = a == b || !is_within(split[a], split[b]) || (is_same && a < b);
        }
        if (is_needed) columns.push_back(split[a]);
      }
    }
  }
  std::ranges::sort(columns);
  std::vector<std::string> letters(different.size());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    for (const std::size_t i : columns[c])
      letters[i] += letter(c);
  }
  return letters;
}

std::vector<std::string> matrix_notes(const Comparison& comparison) {
  std::vector<std::string> notes;
  for (const std::string& note : comparison.notes) {
    const bool is_of_ranks =
        std::ranges::find(comparison.unranked, note) != comparison.unranked.end();
    if (!is_of_ranks) notes.push_back(note);
  }
  // The tests of a mission and source are corrected together.
  struct Family {
    std::size_t tests = 0;
    double least_p = 1;
  };
  std::map<std::pair<std::string, std::string>, Family> families;
  for (const ComparedPair& pair : comparison.pairs) {
    if (!pair.test.p_value) continue;
    Family& family = families[{pair.source, pair.mission}];
    ++family.tests;
    family.least_p = std::min(family.least_p, pair.test.least_p);
  }
  std::map<std::string, std::set<std::string>> missions;
  for (const auto& [key, family] : families) {
    const double tests = static_cast<double>(std::max<std::size_t>(1, family.tests));
    if (tests * family.least_p < kTestLevel) continue;
    const std::string sentence =
        hopeless(family.tests, family.least_p)
            .value_or(fmt::format("too few values: even the clearest difference would have a p "
                                  "of {:.3g}",
                                  family.least_p));
    const bool is_only_source = families.begin()->first.first == families.rbegin()->first.first;
    missions[sentence].insert(is_only_source ? key.second : key.second + " in " + key.first);
  }
  for (const auto& [sentence, of] : missions) {
    notes.push_back(
        fmt::format("{}: {}; a shared letter means nothing there", fmt::join(of, ", "), sentence));
  }
  return notes;
}

std::vector<MethodMatrix> method_matrices(const Comparison& comparison) {
  std::vector<std::string> sources;
  for (const ComparedGroup& group : comparison.groups) {
    if (std::ranges::find(sources, group.source) == sources.end()) sources.push_back(group.source);
  }
  // The source of the campaign's own tests comes first.
  std::stable_partition(sources.begin(), sources.end(),
                        [&](const std::string& source) { return source == comparison.tested; });
  std::vector<MethodMatrix> matrices;
  matrices.reserve(sources.size());
  for (const std::string& source : sources)
    matrices.push_back(matrix_of(comparison, source));
  return matrices;
}

}  // namespace swarmsmith
