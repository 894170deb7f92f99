#include "irace_core/internal/race_loop.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/assert.h"
#include "base/plain_text.h"

namespace swarmsmith {

using irace::RacePlan;

const Candidate::Result* Candidate::on(std::int64_t pair) const {
  const auto found = std::find_if(results.begin(), results.end(),
                                  [&](const Result& result) { return result.pair == pair; });
  return found == results.end() ? nullptr : &*found;
}

/// A later call of the targetEvaluator gives a new cost for a known pair, but no time (irace facts,
/// 18.4), so the time of the run stays.
void Candidate::know(const Result& result) {
  if (on(result.pair) == nullptr) {
    results.push_back(result);
    return;
  }
  for (Result& known : results) {
    if (known.pair != result.pair) continue;
    known.cost = result.cost;
    if (result.time > 0) known.time = result.time;
  }
}

/// The mean is only reported. Ranks decide the order of the elites, since means over different
/// pairs cannot be compared.
Elite Candidate::as_elite(std::int64_t id, double rank) const {
  double sum = 0;
  for (const Result& result : results)
    sum += result.cost;
  const auto n = static_cast<std::int64_t>(results.size());
  return {rank, id, n == 0 ? 0 : sum / static_cast<double>(n), n};
}

IteratedRace::State::State(ParameterSpace space_in, Scenario scenario_in,
                           std::vector<Configuration> initial, Repair repair)
    : space(std::move(space_in)),
      scenario(scenario_in),
      repair_(std::move(repair)),
      schedule_(scenario, space.variable_count()),
      models_(space),
      forbidden_(space),
      total_budget_(schedule_.total_budget()),
      // Each purpose has its own named stream, so the numbers that one of them draws do not change
      // the others (see IteratedRace).
      root_(scenario.seed),
      instances_(scenario, root_.split("instances")),
      initial_(space, root_.split("initial")),
      bound_max_(scenario.bound_max) {
  iterations = schedule_.iterations();
  if (scenario.max_time > 0) time.emplace(scenario, schedule_.pairs_before_test());
  take_initial(std::move(initial));
}

/// A forbidden configuration gets an id, too: ids follow the order of the file (irace facts, 5).
void IteratedRace::State::take_initial(std::vector<Configuration> initial) {
  for (Configuration& configuration : initial) {
    const bool allowed = !forbidden_.contains(configuration);
    const std::int64_t id = add({std::move(configuration), 0, allowed, {}}, 0);
    if (!allowed) {
      warn("initial configuration " + std::to_string(id) +
           " is forbidden and takes no part in the races");
    }
  }
  initial_count_ = static_cast<std::int64_t>(candidates.size());
}

Expected<void> IteratedRace::State::begin() {
  // R's irace also switches it off with a warning (irace facts, 22).
  if (!scenario.elitist && scenario.postselection) {
    warn("there is no post-selection race, since the races are not elitist");
  }
  if (!initial_.uses_sobol()) {
    warn("the first configurations are uniform draws: there are Sobol points for " +
         std::to_string(irace::SobolSequence::most_dimensions()) + " parameters at most");
  }
  // irace facts, 3.1: mu is at least T_f. The default value is raised without a warning, since the
  // user did not choose it.
  const std::int64_t pairs = scenario.first_test * scenario.block_size;
  if (scenario.mu < pairs && scenario.mu != Scenario{}.mu) {
    warn("mu is " + std::to_string(pairs) + " in place of " + std::to_string(scenario.mu) +
         ": it cannot be less than the pairs before the first test");
  }
  // With max_time the number of experiments is not known yet: end_estimate() checks it.
  if (time) return begin_estimate();
  // irace facts, 3.4.
  const std::int64_t least = schedule_.minimum_budget();
  if (budget() < least) {
    return bad_input("a budget of " + counted(budget(), "experiment") +
                         " is too small: with these settings it must be at least " +
                         std::to_string(least),
                     "max_experiments");
  }
  if (auto begun = begin_race(); !begun) return begun;
  advance();
  return {};
}

Expected<std::vector<Measurement>> IteratedRace::State::raised_times(
    std::span<const Measurement> measurements) const {
  std::vector<Measurement> raised(measurements.begin(), measurements.end());
  for (std::size_t i = 0; i < raised.size(); ++i) {
    double& took = raised[i].time;
    // The budget is computed from the mean time of a run (irace facts, 16), so a single missing
    // time would make it wrong. A call of the targetEvaluator needs no time.
    if (time && !wanted[i].is_evaluation && !(took > 0 && std::isfinite(took))) {
      return bad_input(
          "the run of configuration " + std::to_string(wanted[i].configuration) + " on pair " +
          std::to_string(wanted[i].pair) +
          " came without its time, which a budget of time needs: the target must give the "
          "cost and the time of each run");
    }
    // irace facts, 18.2. A time of 0 means that the target did not report one.
    if (took > 0) took = std::max(took, scenario.min_measurable_time);
  }
  return raised;
}

void IteratedRace::State::tell(std::span<const Measurement> measurements) {
  if (finished) return;
  const auto raised = raised_times(measurements);
  if (!raised) {
    fail(raised.error());
    return;
  }
  if (estimate_) {
    tell_estimate(*raised);
    return;
  }
  // `answers_` already has the results of runs that were known (see ask()).
  SWARMSMITH_ASSERT(asked_.size() == raised->size(), "each run has its answer");
  for (std::size_t i = 0; i < asked_.size(); ++i)
    answers_[asked_[i]] = (*raised)[i];
  answer_race();
  advance();
}

void IteratedRace::State::advance() {
  while (!finished) {
    if (race->failure()) {
      fail(*race->failure());
      return;
    }
    if (race->finished()) {
      end_race();
      if (finished) return;
      if (auto begun = begin_race(); !begun) fail(begun.error());
      continue;
    }
    ask();
    // An empty batch means that all results are known (see is_known()): the race gets them at once.
    if (!wanted.empty()) return;
    answer_race();
  }
}

/// The loop of irace facts, 2: the rules of the budget (3.5), models (6), contestants, and the
/// race.
Expected<void> IteratedRace::State::begin_race() {
  // A race that ran nothing leaves budget and results unchanged: the next one would do the same,
  // endlessly.
  const auto next =
      nothing_was_run_
          ? irace::NoMoreRaces{"not enough budget for the first task of a race"}
          : schedule_.next(remaining(), static_cast<std::int64_t>(elites.size()), pairs_seen_);
  // With max_time, remaining() is 0 once the time is used up, so the schedule ends the run then,
  // too (irace facts, 3.5.2).
  if (const auto* end = std::get_if<irace::NoMoreRaces>(&next)) {
    // Without a first race there is no elite to return, so this is an error instead of an end.
    if (races_ == 0) {
      return bad_input("not even one race can be run: " + end->reason +
                       schedule_.advice_for_first_race(remaining()));
    }
    // The reason is kept until the post-selection race is over.
    end_reason_ = end->reason;
    if (!begin_postselection()) stop(*end_reason_);
    return {};
  }
  const auto& plan = std::get<RacePlan>(next);
  iteration = plan.iteration;
  iterations = plan.iterations;
  IterationStarted started{.iteration = plan.iteration,
                           .n_iterations = plan.iterations,
                           .remaining = remaining(),
                           .budget = plan.budget,
                           .n_configurations = 0,
                           .new_pairs = 0,
                           .elites = {},
                           .soft_restart = false,
                           .postselection = false,
                           .model_digest = 0};
  // Sampling reports its configurations, so the event of the iteration is added before.
  const std::size_t place = events.size();
  events.emplace_back(started);
  // The first race takes given configurations and samples the whole space (irace facts, 5). Later
  // races keep the elites and sample from their models (6).
  auto contestants = races_ == 0 ? first_contestants(plan) : later_contestants(plan, started);
  if (!contestants) return Unexpected(contestants.error());
  for (const Elite& elite : elites)
    started.elites.push_back(elite.configuration);
  SWARMSMITH_ASSERT(static_cast<std::int64_t>(contestants->size()) <= plan.configurations,
                    "a race has no more configurations than it was planned for");
  // The number of new pairs is known only now: a deterministic run may have too few unused
  // instances (irace facts, 9.1).
  irace::RaceSettings settings = settings_of(plan);
  started.new_pairs = settings.new_pairs;
  started.n_configurations = static_cast<std::int64_t>(contestants->size());
  events[place] = std::move(started);
  ++races_;
  start_race(std::move(settings), *contestants);
  return {};
}

Expected<void> IteratedRace::State::may_be_extended() const {
  SWARMSMITH_ASSERT(finished, "an extension follows the end");
  if (time) {
    return bad_input("its budget is time, and an extension is in experiments", "max_time");
  }
  if (failure) return bad_input("there is nothing to continue from: " + to_string(*failure));
  return {};
}

/// R's irace has no such command: the rules are in docs/irace.md, "More budget, and an early end".
/// Elites, models, results and used pairs stay as they are.
Expected<void> IteratedRace::State::extend(std::int64_t experiments) {
  if (auto may = may_be_extended(); !may) return may;
  total_budget_ += experiments;
  finished = false;
  end_reason_.reset();
  // With more budget, the first task of a race may fit again.
  nothing_was_run_ = false;
  schedule_.extend(iteration, remaining());
  // If the budget is still too small for a race, this begins the post-selection race or stops.
  if (auto begun = begin_race(); !begun) {
    fail(begun.error());
    return {};
  }
  advance();
  return {};
}

Expected<std::int64_t> IteratedRace::State::least_extension() const {
  constexpr std::int64_t kMost = 10'000'000;
  if (auto may = may_be_extended(); !may) return Unexpected(may.error());
  // Plans with a copy of the schedule, since planning changes it.
  const auto is_enough = [&](std::int64_t experiments) {
    irace::Schedule schedule = schedule_;
    const std::int64_t left = remaining() + experiments;
    schedule.extend(iteration, left);
    return std::holds_alternative<RacePlan>(
        schedule.next(left, static_cast<std::int64_t>(elites.size()), pairs_seen_));
  };
  // Doubling shows whether any extension is enough, and so whether the search below ends.
  std::int64_t enough = 1;
  while (!is_enough(enough)) {
    enough *= 2;
    if (enough > kMost) return bad_input("its options allow no further iteration");
  }
  // Because of rounding down (irace facts, 3.2 and 3.3), a slightly larger budget can be too small
  // again, so bisection is not possible.
  std::int64_t least = 1;
  while (!is_enough(least))
    ++least;
  return least;
}

/// Results that were known before the race cost nothing (decision 10: without elitism, runs of a
/// deterministic target are not repeated).
std::int64_t IteratedRace::State::used() const {
  return used_before_race_ + (race ? race->used() - repeated_ : 0);
}

std::int64_t IteratedRace::State::remaining() const {
  return time ? time->remaining() : budget() - used_before_race_;
}

/// With max_time this is an estimate. It changes after each race with the mean time of the runs.
std::int64_t IteratedRace::State::budget() const {
  return time ? used_before_race_ + time->remaining() : total_budget_;
}

std::vector<std::int64_t> IteratedRace::State::alive() const {
  if (race) return race->alive_ids();
  return estimate_ ? estimate_->batch : std::vector<std::int64_t>{};
}

void IteratedRace::State::warn(std::string text) {
  events.emplace_back(RaceWarning{std::move(text)});
}

void IteratedRace::State::stop(std::string reason) {
  finished = true;
  wanted.clear();
  events.emplace_back(RaceFinished{std::move(reason), elites});
}

/// A failed design has no result, so it keeps no elites, not even those of earlier races.
void IteratedRace::State::fail(Error error) {
  elites.clear();
  estimate_.reset();
  failure = std::move(error);
  stop(to_string(*failure));
}

}  // namespace swarmsmith
