#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "analysis/comparison/internal/score_table.h"
#include "analysis/statistics/effect_size.h"

namespace swarmsmith {
namespace {

/// With fewer values, percentile intervals of the bootstrap miss the true value in more than 5 % of
/// cases.
constexpr std::size_t kFewValues = 10;

/// Two samples of the same length, value by value.
struct PairedValues {
  std::vector<double> first;
  std::vector<double> second;
  std::size_t alone = 0;  ///< number of designs or runs left out because only one sample has them
};

PairedValues pair_designs(const ScoredDesigns& first, const ScoredDesigns& second) {
  PairedValues values;
  for (const auto& [id, design] : first) {
    const auto other = second.find(id);
    if (other == second.end()) continue;
    values.first.push_back(mean_of(design.scores));
    values.second.push_back(mean_of(other->second.scores));
  }
  values.alone = first.size() + second.size() - 2 * values.first.size();
  return values;
}

/// Pairs runs of the same design on the same instance and seed; several such runs give one value,
/// their mean.
PairedValues pair_runs(const ScoredDesigns& first, const ScoredDesigns& second) {
  PairedValues values;
  std::size_t places = 0;
  for (const auto& [id, design] : first)
    places += design.by_place.size();
  for (const auto& [id, design] : second)
    places += design.by_place.size();
  for (const auto& [id, design] : first) {
    const auto other = second.find(id);
    if (other == second.end()) continue;
    for (const auto& [place, scores] : design.by_place) {
      const auto same = other->second.by_place.find(place);
      if (same == other->second.by_place.end()) continue;
      values.first.push_back(mean_of(scores));
      values.second.push_back(mean_of(same->second));
    }
  }
  // Each pair uses one place of each source.
  values.alone = places - 2 * values.first.size();
  return values;
}

void add_notes(ComparedPair& pair) {
  if (!pair.test.p_value) {
    pair.notes.emplace_back(pair.paired ? "all differences are zero: no p"
                                        : "all values are the same: no p");
  }
  if (pair.n_first < 2 || pair.n_second < 2)
    pair.notes.emplace_back("an interval of one value has no width");
  else if (pair.test.least_p < kTestLevel && std::min(pair.n_first, pair.n_second) < kFewValues)
    pair.notes.push_back(
        fmt::format("n is small: an interval of fewer than {} values is too narrow", kFewValues));
  if (pair.test.zeros > 0 && pair.test.p_value)
    pair.notes.push_back(fmt::format("differences of zero, which the test does not use: {} of {}",
                                     pair.test.zeros, pair.n_first));
  if (pair.test.p_value && pair.test.least_p >= kTestLevel) {
    pair.notes.push_back(
        fmt::format("n is too small: even the clearest difference would have an exact p of {:.3g}",
                    pair.test.least_p));
  }
}

ComparedPair tested(ComparedPair pair, const std::vector<double>& first,
                    const std::vector<double>& second) {
  pair.n_first = first.size();
  pair.n_second = second.size();
  pair.test = pair.paired ? signed_rank_test(first, second) : rank_sum_test(first, second);
  pair.a12 = vargha_delaney(first, second);
  pair.difference =
      pair.paired ? paired_mean_difference(first, second) : mean_difference(first, second);
  add_notes(pair);
  return pair;
}

void compare_sources(const ScoreTable::value_type& one, const ScoreTable::value_type& other,
                     Comparison& comparison) {
  const bool by_run = comparison.unit == ScoreUnit::Run;
  const PairedValues values =
      by_run ? pair_runs(one.second, other.second) : pair_designs(one.second, other.second);
  const GroupKey& key = one.first;
  if (values.first.empty()) {
    comparison.notes.push_back(
        fmt::format("{}, {}: {} and {} have no {} in common, so they are not compared", key.mission,
                    key.method, key.source, other.first.source,
                    by_run ? "run of the same design, instance and seed" : "design"));
    return;
  }
  ComparedPair pair = tested({.mission = key.mission,
                              .method = key.method,
                              .first = key.source,
                              .second = other.first.source,
                              .paired = true},
                             values.first, values.second);
  if (values.alone > 0) {
    pair.notes.push_back(fmt::format("{} left out, since only one of the two sources has them: {}",
                                     by_run ? "runs" : "designs", values.alone));
  }
  comparison.pairs.push_back(std::move(pair));
}

}  // namespace

void add_source_pairs(const ScoreTable& table, Comparison& comparison) {
  for (auto one = table.begin(); one != table.end(); ++one) {
    for (auto other = std::next(one); other != table.end(); ++other) {
      const bool same =
          one->first.mission == other->first.mission && one->first.method == other->first.method;
      if (same) compare_sources(*one, *other, comparison);
    }
  }
}

void add_method_pairs(const ScoreTable& table, Comparison& comparison) {
  const ScoreUnit unit = comparison.unit;
  for (auto one = table.begin(); one != table.end(); ++one) {
    for (auto other = std::next(one); other != table.end(); ++other) {
      const GroupKey& first = one->first;
      const GroupKey& second = other->first;
      if (first.mission != second.mission || first.source != second.source) continue;
      comparison.pairs.push_back(tested({.mission = first.mission,
                                         .source = first.source,
                                         .first = first.method,
                                         .second = second.method},
                                        values_of(one->second, unit),
                                        values_of(other->second, unit)));
    }
  }
}

}  // namespace swarmsmith
