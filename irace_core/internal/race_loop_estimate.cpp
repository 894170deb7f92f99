#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/assert.h"
#include "irace_core/expression.h"
#include "irace_core/internal/capping.h"
#include "irace_core/internal/race_loop.h"
#include "irace_core/internal/ranking.h"

namespace swarmsmith {

/// Starts the estimate of irace facts, 16: some configurations run on the first T_f pairs, and
/// their mean time converts max_time into a number of experiments.
Expected<void> IteratedRace::State::begin_estimate() {
  estimate_ =
      Estimate{.tried = {}, .batch = {}, .runs = {}, .pairs = schedule_.pairs_before_test()};
  instances_.extend_to(std::max(estimate_->pairs, scenario.n_instances));
  // If the first batch could exceed the time of the estimate, its runs get a smaller bound.
  const double bound = time->bound_for_estimate();
  if (bound > 0 && bound_max_ > bound) lower_bound_max(bound);
  auto asked = ask_estimate(time->first_configurations());
  if (!asked) return Unexpected(asked.error());
  if (!*asked) {
    return bad_input(
        "no configuration that is not forbidden was found: the constraints are too strict; forbid "
        "less, or narrow the domains instead");
  }
  return {};
}

void IteratedRace::State::lower_bound_max(double bound) {
  warn("bound_max, the bound of runs, is lowered from " + to_fixed_text(bound_max_) + " to " +
       to_fixed_text(bound) +
       ": the runs so far and the remaining time show that it is much too large");
  bound_max_ = bound;
}

Expected<bool> IteratedRace::State::ask_estimate(std::int64_t count) {
  auto& batch = estimate_->batch;
  batch.clear();
  // Given configurations have the smallest ids and are tried first, in their order, so the last
  // tried id shows where to continue. Then points of the Sobol sequence follow.
  const std::int64_t last = estimate_->tried.empty() ? 0 : estimate_->tried.back();
  for (std::int64_t id = last + 1; id <= initial_count_; ++id) {
    if (static_cast<std::int64_t>(batch.size()) == count) break;
    if (candidate(id).takes_part) batch.push_back(id);
  }
  if (static_cast<std::int64_t>(batch.size()) < count) {
    auto sampled = sample_initial(count - static_cast<std::int64_t>(batch.size()), 1);
    if (!sampled) return Unexpected(sampled.error());
    batch.insert(batch.end(), sampled->begin(), sampled->end());
  }
  // Canonical order: pair by pair, as in a race.
  wanted.clear();
  for (std::int64_t pair = 1; pair <= estimate_->pairs; ++pair) {
    for (const std::int64_t id : batch) {
      wanted.push_back({.configuration = id,
                        .pair = pair,
                        .instance = instances_[pair].instance,
                        .seed = instances_[pair].seed,
                        .bound = bound_max_});
    }
  }
  return !batch.empty();
}

/// Makes the check that a race makes in its own runs.
Expected<void> IteratedRace::State::check_bounds(std::span<const Measurement> measurements) const {
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Experiment& run = wanted[i];
    const double took = measurements[i].time;
    if (run.bound == 0 || took <= run.bound + scenario.min_measurable_time) continue;
    return bad_input("the run of configuration " + std::to_string(run.configuration) + " on pair " +
                     std::to_string(run.pair) + " took " + exact_text(took) +
                     ", more than its bound of " + exact_text(run.bound) +
                     ": a target must stop itself at the bound");
  }
  return {};
}

void IteratedRace::State::tell_estimate(std::span<const Measurement> measurements) {
  if (auto checked = check_bounds(measurements); !checked) {
    fail(checked.error());
    return;
  }
  // irace facts, 18.4: the costs come from a second call for each run, after all runs. `task`
  // distinguishes it from later calls for the same configuration and pair.
  if (scenario.target_evaluator && estimate_->runs.empty()) {
    estimate_->runs.assign(measurements.begin(), measurements.end());
    for (Experiment& experiment : wanted) {
      experiment.bound = 0;
      experiment.is_evaluation = true;
      experiment.task = steps_ + experiment.pair;
    }
    return;
  }
  if (estimate_->runs.empty()) estimate_->runs.assign(measurements.begin(), measurements.end());
  if (auto ended = end_batch(measurements); !ended) fail(ended.error());
}

Expected<void> IteratedRace::State::end_batch(std::span<const Measurement> costs) {
  SWARMSMITH_ASSERT(costs.size() == wanted.size() && estimate_->runs.size() == wanted.size(),
                    "each run of the batch has its time and its cost");
  const irace::TimeRules rules = common_settings(0).time_rules();
  std::vector<std::pair<std::int64_t, std::int64_t>> evaluated;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const auto [id, pair] = std::pair(wanted[i].configuration, wanted[i].pair);
    evaluated.emplace_back(id, pair);
    // Each run counts, also those of a rejected configuration (decision 10): its time is used up.
    time->count(estimate_->runs[i].time);
    // The costs go into the first race, so they follow the rules of a race (irace facts, 17).
    const double cost =
        uses_capping(scenario)
            ? irace::capped_cost(costs[i].cost, estimate_->runs[i].time, bound_max_, rules)
            : costs[i].cost;
    // irace facts, 12. A rejected configuration takes no part in the races.
    if (std::isinf(cost) && candidate(id).takes_part) reject(id);
    if (candidate(id).takes_part) candidate(id).know({pair, cost, estimate_->runs[i].time});
    pairs_seen_ = std::max(pairs_seen_, pair);
  }
  // The estimate is part of the design: its runs count as experiments, and its pairs as steps.
  used_before_race_ += static_cast<std::int64_t>(wanted.size());
  steps_ += estimate_->pairs;
  estimate_->runs.clear();
  estimate_->tried.insert(estimate_->tried.end(), estimate_->batch.begin(), estimate_->batch.end());
  // The number of experiments that fit in the remaining time, with the new mean time.
  time->estimate();
  report_time(std::move(evaluated));
  const auto tried = static_cast<std::int64_t>(estimate_->tried.size());
  // Step 3 of irace facts, 16. The estimate also ends if no further configuration can be sampled.
  if (const std::int64_t more = time->more_configurations(tried); more > 0) {
    auto asked = ask_estimate(more);
    if (!asked) return Unexpected(asked.error());
    if (*asked) return {};
  }
  return end_estimate();
}

Expected<void> IteratedRace::State::end_estimate() {
  // irace facts, 16: a bound above twice the mean time is lowered.
  const double bound = 2 * time->mean_time();
  if (bound_max_ > bound) lower_bound_max(bound);
  // irace facts, 3.4: a budget of time that is too small for the usual plan gives fewer iterations
  // instead of an error.
  auto shrunk = schedule_.shrink_to(time->remaining());
  if (!shrunk) return Unexpected(shrunk.error());
  if (*shrunk) {
    iterations = schedule_.iterations();
    warn("with an estimated time of " + to_fixed_text(time->mean_time()) +
         " per run, the remaining time is too short for the usual number of iterations: there "
         "are " +
         std::to_string(iterations) +
         ", with few configurations each, and the result may be no better than a random search");
  }
  std::vector<std::int64_t> ids = std::move(estimate_->tried);
  std::erase_if(ids, [&](std::int64_t id) { return !candidate(id).takes_part; });
  // All configurations of the estimate enter the first race as elites, so that their runs are not
  // repeated (irace facts, 16). first_contestants() keeps the best if there are too many.
  elites = ranked(ids);
  estimate_.reset();
  time->end_estimate();
  if (auto begun = begin_race(); !begun) return begun;
  advance();
  return {};
}

/// A pair on which a configuration was not run is NaN: overall ranks put more pairs before fewer
/// (irace facts, 11).
std::vector<Elite> IteratedRace::State::ranked(std::span<const std::int64_t> ids) const {
  std::vector<std::vector<double>> costs;
  for (const std::int64_t id : ids) {
    auto& row = costs.emplace_back(static_cast<std::size_t>(pairs_seen_),
                                   std::numeric_limits<double>::quiet_NaN());
    for (const Candidate::Result& result : candidate(id).results) {
      SWARMSMITH_ASSERT(result.pair >= 1 && result.pair <= pairs_seen_,
                        "results are of seen pairs");
      row[static_cast<std::size_t>(result.pair - 1)] = result.cost;
    }
  }
  const std::vector<double> ranks = irace::overall_ranks(costs, test_type_of(scenario));
  std::vector<Elite> ranked;
  for (std::size_t i = 0; i < ids.size(); ++i)
    ranked.push_back(candidate(ids[i]).as_elite(ids[i], ranks[i]));
  return ranked;
}

void IteratedRace::State::report_time(
    std::vector<std::pair<std::int64_t, std::int64_t>> evaluated) {
  events.emplace_back(TimeEstimated{.runs = time->runs(),
                                    .used = time->used(),
                                    .mean_time = time->mean_time(),
                                    .remaining = time->remaining(),
                                    .bound_max = bound_max_,
                                    .evaluated = std::move(evaluated)});
}

}  // namespace swarmsmith
