#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "base/assert.h"
#include "irace_core/internal/race_loop.h"

namespace swarmsmith {

using irace::Race;

irace::RaceSettings IteratedRace::State::common_settings(std::int64_t race_budget) const {
  return {.elitist = scenario.elitist,
          .test_type = test_type_of(scenario),
          .first_test = schedule_.pairs_before_test(),
          .pairs_between_tests = schedule_.pairs_between_tests(),
          .block_size = scenario.block_size,
          .elitist_limit = scenario.elitist_limit,
          .confidence = scenario.confidence,
          .min_survival = schedule_.min_survival(),
          .max_experiments = race_budget,
          .experiments_left = time ? std::numeric_limits<std::int64_t>::max() : remaining(),
          .pairs = {},
          .past_pairs = scenario.elitist ? pairs_seen_ : 0,
          .one_task_at_a_time = scenario.one_task_at_a_time,
          .target_evaluator = scenario.target_evaluator,
          .capping = uses_capping(scenario),
          .capping_after_first_test = scenario.capping_after_first_test,
          .capping_type = scenario.capping_type,
          .bound_type = scenario.bound_type,
          .bound_max = bound_max_,
          .bound_digits = scenario.bound_digits,
          .bound_par = scenario.bound_par,
          .bound_as_timeout = scenario.bound_as_timeout,
          .min_measurable_time = scenario.min_measurable_time};
}

irace::RaceSettings IteratedRace::State::settings_of(const irace::RacePlan& plan) {
  irace::RaceSettings settings = common_settings(std::min(plan.budget, remaining()));
  settings.new_pairs = plan.new_pairs;
  order_pairs(settings);
  return settings;
}

/// With elitism: first the new pairs, so that elites do not stay elites only by luck on past pairs;
/// then the past pairs, on which new configurations must beat the elites; then the other unused
/// pairs. Without elitism: the unused pairs, or all pairs from the first if the target is
/// deterministic (irace facts, 9.1).
void IteratedRace::State::order_pairs(irace::RaceSettings& settings) {
  // Enough pairs that the budget ends first: when a race may stop, a task on a new pair costs at
  // least min_survival + 1 runs (rule 9.3.2 a of irace facts).
  const std::int64_t fresh = settings.max_experiments / settings.min_survival + 1 +
                             settings.new_pairs + settings.first_test +
                             settings.pairs_between_tests;
  instances_.extend_to(pairs_seen_ + fresh);
  std::int64_t first = pairs_seen_ + 1;
  if (scenario.deterministic) {
    const std::int64_t unused = instances_.size() - pairs_seen_;
    schedule_.limit_new_pairs(unused);
    settings.new_pairs = std::min(settings.new_pairs, unused);
    if (!scenario.elitist) first = 1;
  }
  std::vector<std::int64_t>& pairs = settings.pairs;
  for (std::int64_t pair = first; pair <= instances_.size(); ++pair)
    pairs.push_back(pair);
  std::vector<std::int64_t> past(static_cast<std::size_t>(settings.past_pairs));
  std::iota(past.begin(), past.end(), std::int64_t{1});
  if (scenario.sample_instances) shuffle_past(past);
  SWARMSMITH_ASSERT(settings.new_pairs <= static_cast<std::int64_t>(pairs.size()),
                    "new pairs are among the unused ones");
  pairs.insert(pairs.begin() + static_cast<std::ptrdiff_t>(settings.new_pairs), past.begin(),
               past.end());
}

/// Shuffles by blocks, so that each block is tried as a whole (R shuffles single pairs: irace
/// facts, 25.7). If rejections left a part of the last block unused, that block stays at
/// the end.
void IteratedRace::State::shuffle_past(std::span<std::int64_t> past) const {
  const std::int64_t size = scenario.block_size;
  std::vector<std::int64_t> blocks(past.size() / static_cast<std::size_t>(size));
  std::iota(blocks.begin(), blocks.end(), std::int64_t{0});
  Rng rng = root_.split("order", static_cast<std::uint64_t>(iteration));
  rng.shuffle(std::span(blocks));
  for (std::size_t i = 0; i < blocks.size() * static_cast<std::size_t>(size); ++i) {
    const auto position = static_cast<std::int64_t>(i);
    past[i] = blocks[static_cast<std::size_t>(position / size)] * size + position % size + 1;
  }
}

irace::Contestant IteratedRace::State::contestant(std::int64_t id,
                                                  std::span<const std::int64_t> pairs) const {
  irace::Contestant known{id, {}, {}};
  if (candidate(id).results.empty()) return known;
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  std::vector<Candidate::Result> by_pair(static_cast<std::size_t>(pairs_seen_) + 1,
                                         {0, kNothing, kNothing});
  for (const Candidate::Result& result : candidate(id).results) {
    SWARMSMITH_ASSERT(result.pair >= 1 && result.pair <= pairs_seen_, "results are of seen pairs");
    by_pair[static_cast<std::size_t>(result.pair)] = result;
  }
  for (const std::int64_t pair : pairs) {
    known.past.push_back(by_pair[static_cast<std::size_t>(pair)].cost);
    known.past_times.push_back(by_pair[static_cast<std::size_t>(pair)].time);
  }
  return known;
}

void IteratedRace::State::start_race(irace::RaceSettings settings,
                                     const std::vector<std::int64_t>& contestants) {
  const auto past = std::span<const std::int64_t>(settings.pairs)
                        .subspan(static_cast<std::size_t>(settings.new_pairs),
                                 static_cast<std::size_t>(settings.past_pairs));
  std::vector<irace::Contestant> all;
  all.reserve(contestants.size());
  for (const std::int64_t id : contestants) {
    all.push_back(settings.past_pairs > 0 ? contestant(id, past) : irace::Contestant{id, {}, {}});
  }
  repeated_ = 0;
  told_.clear();
  race = std::make_unique<Race>(std::move(settings), std::move(all));
  report_steps();
}

bool IteratedRace::State::is_known(const irace::RaceRun& run) const {
  return scenario.deterministic && !scenario.elitist && !run.is_evaluation &&
         candidate(race->contestant(run.column).id).on(race->pair_of(run.task)) != nullptr;
}

void IteratedRace::State::ask() {
  wanted.clear();
  asked_.clear();
  runs_.assign(race->wanted().begin(), race->wanted().end());
  answers_.assign(runs_.size(), {});
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    const irace::RaceRun& run = runs_[i];
    const std::int64_t id = race->contestant(run.column).id;
    const std::int64_t pair = race->pair_of(run.task);
    if (is_known(run)) {
      const Candidate::Result& known = *candidate(id).on(pair);
      answers_[i] = {known.cost, known.time};
      continue;
    }
    asked_.push_back(i);
    Experiment& experiment = wanted.emplace_back(experiment_of(run));
    if (!run.is_evaluation) continue;
    // The first wanted run belongs to the next step.
    const auto later = static_cast<std::int64_t>(run.task - runs_.front().task);
    experiment.is_evaluation = true;
    experiment.task = steps_ + 1 + later;
  }
}

Experiment IteratedRace::State::experiment_of(const irace::RaceRun& run) const {
  const std::int64_t pair = race->pair_of(run.task);
  return {.configuration = race->contestant(run.column).id,
          .pair = pair,
          .instance = instances_[pair].instance,
          .seed = instances_[pair].seed,
          .bound = run.bound};
}

std::vector<Experiment> IteratedRace::State::ahead(std::int64_t pairs) const {
  std::vector<Experiment> experiments;
  // With max_time the remaining budget, and so the questions, depend on times that are not known
  // yet.
  if (finished || !race || time) return experiments;
  for (const irace::RaceRun& run : race->ahead(pairs)) {
    if (!is_known(run)) experiments.push_back(experiment_of(run));
  }
  return experiments;
}

void IteratedRace::State::answer_race() {
  SWARMSMITH_ASSERT(answers_.size() == runs_.size(), "each run has its answer");
  if (keeps_track()) {
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (runs_[i].is_evaluation) continue;
      const std::int64_t id = race->contestant(runs_[i].column).id;
      told_[{race->pair_of(runs_[i].task), id}] = {answers_[i].time, is_known(runs_[i])};
    }
  }
  race->tell(answers_);
  report_steps();
}

bool IteratedRace::State::keeps_track() const {
  return time || (scenario.deterministic && !scenario.elitist);
}

/// Adds up the times of the runs that count, and removes known runs from the step.
void IteratedRace::State::count_runs(RaceStep& step) {
  std::vector<std::pair<std::int64_t, std::int64_t>> evaluated;
  for (const auto& [id, pair] : step.evaluated) {
    const auto told = told_.extract({pair, id});
    SWARMSMITH_ASSERT(!told.empty(), "each evaluated run of a step has a known cost");
    if (told.mapped().was_known) {
      ++repeated_;
      continue;
    }
    evaluated.emplace_back(id, pair);
    if (time) time->count(told.mapped().time);
  }
  step.evaluated = std::move(evaluated);
  step.experiments_used -= repeated_;
}

void IteratedRace::State::report_steps() {
  for (RaceStep& step : race->take_steps()) {
    if (keeps_track()) count_runs(step);
    step.iteration = iteration;
    step.experiments_used += used_before_race_;
    Digest digest;
    digest.add(step.digest);
    digest.add(step.experiments_used);
    digest.add(instances_.rng().drawn());
    digest.add(sampling_drawn_);
    step.digest = digest.value64();
    ++steps_;
    events.emplace_back(std::move(step));
  }
}

void IteratedRace::State::reject(std::int64_t id) {
  candidate(id).takes_part = false;
  forbidden_.add_rejected(candidate(id).configuration.get());
}

/// After a race, some candidate has been tried on each of the first pairs_seen_ pairs: tasks use
/// unused pairs in the order of the list.
void IteratedRace::State::take_over_results() {
  for (std::size_t column = 0; column < race->size(); ++column) {
    const std::int64_t id = race->contestant(column).id;
    if (race->is_rejected(column)) {
      reject(id);
      continue;
    }
    for (const Race::Result& result : race->results(column)) {
      candidate(id).know({result.pair, result.cost, result.time});
      pairs_seen_ = std::max(pairs_seen_, result.pair);
    }
  }
}

void IteratedRace::State::end_race() {
  const std::int64_t used = race->used() - repeated_;
  used_before_race_ += used;
  SWARMSMITH_ASSERT(time || used_before_race_ <= total_budget_,
                    "a design never runs more than its budget");
  SWARMSMITH_ASSERT(used >= 0, "the repeated runs are part of the race's runs");
  nothing_was_run_ = used == 0;
  take_over_results();
  choose_elites();
  if (elites.empty() && end_reason_) fall_back();
  put_away_losers();
  ended_.push_back(elites);
  const std::string reason = race->stop_reason();
  race.reset();
  repeated_ = 0;
  if (time) time->estimate();
  events.emplace_back(IterationEnded{iteration, used, remaining(), reason, elites});
  if (time) report_time({});
  if (elites.empty()) {
    fail({ErrorKind::BadInput, "every configuration was rejected", ""});
  } else if (end_reason_) {
    stop(*end_reason_);
  }
}

void IteratedRace::State::put_away_losers() {
  for (std::size_t column = 0; column < race->size(); ++column) {
    const std::int64_t id = race->contestant(column).id;
    if (std::ranges::count(elites, id, &Elite::configuration) > 0) continue;
    candidate(id).configuration.put_away();
    candidate(id).results.shrink_to_fit();
  }
}

/// Takes the survivors by rank, each configuration once, up to the number of survivors (irace
/// facts, 13): two elites that are copies would only narrow the models.
void IteratedRace::State::choose_elites() {
  elites.clear();
  for (const Race::Survivor& survivor : race->survivors()) {
    if (static_cast<std::int64_t>(elites.size()) == schedule_.min_survival()) break;
    const std::int64_t id = race->contestant(survivor.column).id;
    const bool is_copy = std::any_of(elites.begin(), elites.end(), [&](const Elite& elite) {
      return candidate(elite.configuration).configuration.get() ==
             candidate(id).configuration.get();
    });
    if (!is_copy) elites.push_back(candidate(id).as_elite(id, survivor.rank));
  }
}

}  // namespace swarmsmith
