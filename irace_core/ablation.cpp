#include "irace_core/ablation.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "irace_core/internal/race.h"
#include "irace_core/internal/ranking.h"

namespace swarmsmith {
namespace {

/// Nothing when the values do not fit together.
std::optional<AblationChange> change(const ParameterSpace& space, const Configuration& current,
                                     const Configuration& target, std::size_t parameter) {
  if (!current.is_active(parameter) || !target.is_active(parameter)) return std::nullopt;
  AblationChange made{Configuration(), {parameter}};
  Assignment values(space);
  for (const std::size_t i : space.hierarchy_order()) {
    const bool was_active = current.is_active(i);
    const bool is_active = space.is_active(i, values);
    const bool is_new = i == parameter || (is_active && !was_active);
    if (is_active) {
      const Configuration& from = is_new ? target : current;
      if (from.is_active(i)) values.set(i, from[i]);
    }
    if (i != parameter && is_active != was_active) made.changed.push_back(i);
  }
  made.configuration = values.configuration();
  if (!space.check(made.configuration) || space.is_forbidden(made.configuration)) {
    return std::nullopt;
  }
  return made;
}

}  // namespace

std::vector<std::size_t> differences(const Configuration& a, const Configuration& b) {
  std::vector<std::size_t> different;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool equal = a.is_active(i) == b.is_active(i) && (!a.is_active(i) || a[i] == b[i]);
    if (!equal) different.push_back(i);
  }
  return different;
}

std::vector<AblationChange> ablation_changes(const ParameterSpace& space,
                                             const Configuration& current,
                                             const Configuration& target,
                                             std::span<const std::size_t> open) {
  std::vector<AblationChange> changes;
  for (const std::size_t parameter : open) {
    if (current.is_active(parameter) && target.is_active(parameter) &&
        current[parameter] == target[parameter])
      continue;
    if (auto made = change(space, current, target, parameter)) changes.push_back(std::move(*made));
  }
  return changes;
}

Expected<std::optional<std::size_t>> best_change(const Scenario& scenario, AblationType type,
                                                 std::size_t changes, std::int64_t pairs,
                                                 const AblationRuns& run) {
  const auto count = static_cast<std::int64_t>(changes);
  const bool races = type == AblationType::Racing && count > 1;
  irace::RaceSettings settings{
      .elitist = false,
      .test_type = test_type_of(scenario),
      .first_test = races ? scenario.first_test * scenario.block_size : pairs,
      .pairs_between_tests = scenario.each_test * scenario.block_size,
      .block_size = scenario.block_size,
      .confidence = scenario.confidence,
      .min_survival = races ? 1 : 0,
      .max_experiments = count * pairs,
      .target_evaluator = scenario.target_evaluator,
      .bound_max = scenario.bound_max,
      .min_measurable_time = scenario.min_measurable_time};
  settings.pairs.resize(static_cast<std::size_t>(pairs));
  std::iota(settings.pairs.begin(), settings.pairs.end(), std::int64_t{1});
  std::vector<irace::Contestant> contestants;
  for (std::int64_t i = 1; i <= count; ++i)
    contestants.push_back({i, {}, {}});
  irace::Race race(std::move(settings), std::move(contestants));
  while (!race.finished()) {
    std::vector<Experiment> wanted;
    for (const irace::RaceRun& asked : race.wanted()) {
      wanted.push_back({.configuration = static_cast<std::int64_t>(asked.column) + 1,
                        .pair = race.pair_of(asked.task),
                        .bound = asked.bound,
                        .is_evaluation = asked.is_evaluation,
                        .task = static_cast<std::int64_t>(asked.task) + 1});
    }
    const auto made = run(wanted);
    if (!made) return Unexpected(made.error());
    race.tell(*made);
  }
  if (race.failure()) return Unexpected(*race.failure());
  // As R: the ranks are those of all changes, also of those that the last test dropped.
  std::vector<std::size_t> ranked;
  std::vector<std::vector<double>> costs;
  for (std::size_t c = 0; c < changes; ++c) {
    if (race.is_rejected(c)) continue;
    ranked.push_back(c);
    costs.emplace_back(static_cast<std::size_t>(pairs), std::numeric_limits<double>::quiet_NaN());
    for (const irace::Race::Result& result : race.results(c))
      costs.back()[static_cast<std::size_t>(result.pair - 1)] = result.cost;
  }
  if (ranked.empty()) return std::optional<std::size_t>();
  return ranked[best_by_ranks(costs, test_type_of(scenario))];
}

std::size_t best_by_ranks(const std::vector<std::vector<double>>& costs, TestType type) {
  const std::vector<double> ranks = irace::overall_ranks(costs, type);
  return static_cast<std::size_t>(std::ranges::min_element(ranks) - ranks.begin());
}

}  // namespace swarmsmith
