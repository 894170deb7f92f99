#include "coordinator/design/design_runner.h"

#include <limits>
#include <utility>

#include "base/assert.h"
#include "base/overloaded.h"
#include "base/rng.h"
#include "target/cost.h"

namespace swarmsmith {
namespace {

constexpr double kRejected = std::numeric_limits<double>::infinity();
constexpr std::int64_t kLargestSeed = 2'147'483'647;

/// The fresh seeds on which a design's winner is scored: a stream of their own, so that they meet
/// no pair of the race but by chance.
Experiment test_experiment(const DesignPlan& plan, std::int64_t candidate, std::int64_t number) {
  Rng rng = Rng(static_cast<std::uint64_t>(plan.row.seed))
                .split("test", static_cast<std::uint64_t>(number));
  return {.configuration = candidate,
          .pair = number,
          .instance = 1,
          .seed = rng.uniform_int(1, kLargestSeed)};
}

std::uint64_t key_of(const EvaluationKey& key) {
  return DesignRunner::key_of(number_of(key.candidate), key.pair);
}

}  // namespace

Expected<DesignRunner> DesignRunner::start(DesignPlan plan, StoredDesign stored) {
  auto race = IteratedRace::start(plan.space, plan.scenario);
  if (!race) return Unexpected(race.error());
  return DesignRunner(std::move(plan), std::move(stored), std::move(*race));
}

DesignRunner::DesignRunner(DesignPlan plan, StoredDesign stored, IteratedRace race)
    : plan_(std::move(plan)), stored_(std::move(stored)), race_(std::move(race)) {}

Expected<void> DesignRunner::advance(std::vector<Task>& tasks, std::vector<Row>& rows) {
  if (state_ == DesignState::Waiting) {
    state_ = DesignState::Racing;
    if (auto recorded = record_events(rows); !recorded) return recorded;
    want_batch(tasks, rows);
  }
  while (state_ == DesignState::Racing && awaited_.empty()) {
    if (race_.finished()) {
      if (auto ended = finish_race(tasks, rows); !ended) return ended;
      break;
    }
    consumed_ = 0;
    race_.tell(costs_);
    if (auto recorded = record_events(rows); !recorded) return recorded;
    record_unused(batch_.size(), rows);
    want_batch(tasks, rows);
  }
  if (state_ == DesignState::Testing && awaited_.empty()) {
    state_ = DesignState::Finished;
    record_state(rows);
  }
  return {};
}

Expected<void> DesignRunner::finish_race(std::vector<Task>& tasks, std::vector<Row>& rows) {
  if (steps_ < stored_.step_digests.size()) return Unexpected(other_way());
  if (race_.failure()) {
    state_ = DesignState::Stopped;
    reason_ = to_string(*race_.failure());
    record_state(rows);
    return {};
  }
  state_ = DesignState::Testing;
  record_state(rows);
  want_tests(tasks, rows);
  return {};
}

void DesignRunner::want_batch(std::vector<Task>& tasks, std::vector<Row>& rows) {
  const auto wanted = race_.wanted();
  batch_.assign(wanted.begin(), wanted.end());
  costs_.assign(batch_.size(), 0);
  scores_.assign(batch_.size(), {});
  for (std::size_t i = 0; i < batch_.size(); ++i) {
    const Experiment& experiment = batch_[i];
    if (experiment.pair > pairs_known_) {
      pairs_known_ = experiment.pair;
      record_pair(Purpose::Race, experiment, rows);
    }
    want(i, {candidate(experiment.configuration), Purpose::Race, experiment.pair}, experiment,
         tasks, rows);
  }
}

void DesignRunner::want_tests(std::vector<Task>& tasks, std::vector<Row>& rows) {
  batch_.clear();
  for (std::int64_t number = 1; number <= plan_.test_count; ++number) {
    batch_.push_back(test_experiment(plan_, best_, number));
  }
  costs_.assign(batch_.size(), 0);
  scores_.assign(batch_.size(), {});
  for (std::size_t i = 0; i < batch_.size(); ++i) {
    const Experiment& experiment = batch_[i];
    record_pair(Purpose::Test, experiment, rows);
    want(i, {candidate(experiment.configuration), Purpose::Test, experiment.pair}, experiment,
         tasks, rows);
  }
}

void DesignRunner::record_pair(Purpose purpose, const Experiment& experiment,
                               std::vector<Row>& rows) const {
  record(PairRow{.design = plan_.row.id,
                 .purpose = purpose,
                 .number = experiment.pair,
                 .instance = experiment.instance,
                 .seed = experiment.seed},
         rows);
}

void DesignRunner::want(std::size_t position, const EvaluationKey& key,
                        const Experiment& experiment, std::vector<Task>& tasks,
                        std::vector<Row>& rows) {
  const std::uint64_t packed = swarmsmith::key_of(key);
  auto& known = key.purpose == Purpose::Race ? stored_.race_scores : stored_.test_scores;
  if (const auto score = known.extract(packed)) return put(position, score.mapped());
  if (key.purpose == Purpose::Race) {
    if (const auto score = unused_.extract(packed)) {
      put(position, score.mapped());
      // The store has the evaluation, and takes the iteration from this row.
      record(EvaluationRow{.key = key,
                           .iteration = iteration_,
                           .status = score.mapped().status,
                           .score = score.mapped().score,
                           .state_digest = score.mapped().state_digest,
                           .source = plan_.source},
             rows);
      return;
    }
  }
  awaited_.emplace(packed, position);
  tasks.push_back({.key = key,
                   .mission = plan_.mission,
                   .method = plan_.method,
                   .instance = experiment.instance,
                   .seed = experiment.seed,
                   .machine = machines_[static_cast<std::size_t>(experiment.configuration - 1)]});
}

void DesignRunner::put(std::size_t position, const StoredScore& score) {
  scores_[position] = score;
  costs_[position] = score.status == EvaluationStatus::Ok ? to_cost(score.score) : kRejected;
}

void DesignRunner::tell(const Outcome& outcome, std::vector<Row>& rows) {
  const auto found = awaited_.find(swarmsmith::key_of(outcome.key));
  SWARMSMITH_ASSERT(found != awaited_.end(), "an outcome is told once, and only when wanted");
  put(found->second, {outcome.key, outcome.status, outcome.score, outcome.state_digest});
  awaited_.erase(found);
  rows.emplace_back(
      EvaluationRow{.key = outcome.key,
                    .iteration = outcome.key.purpose == Purpose::Race ? iteration_ : 0,
                    .status = outcome.status,
                    .score = outcome.score,
                    .state_digest = outcome.state_digest,
                    .source = plan_.source,
                    .wall_us = outcome.wall_us,
                    .worker = outcome.worker,
                    .attempt = outcome.attempt});
}

Expected<void> DesignRunner::record_events(std::vector<Row>& rows) {
  for (const RaceEvent& event : race_.take_events()) {
    auto recorded =
        std::visit(Overloaded{[&](const ConfigurationSampled& sampled) -> Expected<void> {
                                record_candidate(sampled, rows);
                                return {};
                              },
                              [&](const IterationStarted& started) -> Expected<void> {
                                record_iteration_start(started, rows);
                                return {};
                              },
                              [&](const RaceStep& step) { return record_step(step, rows); },
                              [&](const IterationEnded& ended) -> Expected<void> {
                                record_iteration_end(ended, rows);
                                return {};
                              },
                              [&](const TimeEstimated&) -> Expected<void> { return {}; },
                              [&](const RaceWarning&) -> Expected<void> { return {}; },
                              [&](const RaceFinished& finished) -> Expected<void> {
                                reason_ = finished.reason;
                                return {};
                              }},
                   event);
    if (!recorded) return recorded;
  }
  return {};
}

void DesignRunner::record_candidate(const ConfigurationSampled& sampled, std::vector<Row>& rows) {
  SWARMSMITH_ASSERT(sampled.id == static_cast<std::int64_t>(machines_.size()) + 1,
                    "configurations are numbered in the order of their creation");
  CandidateText text = plan_.describe(sampled.configuration);
  machines_.push_back(text.machine);
  totals_.emplace_back();
  alive_.insert(sampled.id);
  record(CandidateRow{.id = candidate(sampled.id),
                      .iteration = sampled.iteration,
                      .parent = candidate(sampled.parent),
                      .parameters = std::move(text.parameters),
                      .machine = std::move(text.machine),
                      .modules = std::move(text.modules),
                      .states = text.states,
                      .transitions = text.transitions},
         rows);
}

void DesignRunner::record_iteration_start(const IterationStarted& started, std::vector<Row>& rows) {
  iteration_ = started.iteration;
  record(IterationRow{.design = plan_.row.id,
                      .number = started.iteration,
                      .of = started.n_iterations,
                      .budget = started.budget,
                      .configurations = started.n_configurations,
                      .elites = static_cast<std::int64_t>(started.elites.size()),
                      .soft_restart = started.soft_restart,
                      .model_digest = started.model_digest},
         rows);
}

Expected<void> DesignRunner::record_step(const RaceStep& step, std::vector<Row>& rows) {
  record_consumed(step, rows);
  const auto number = static_cast<std::int64_t>(steps_) + 1;
  used_ = step.experiments_used;
  best_ = step.best;
  best_mean_ = to_score(step.mean_best);
  record(RaceStepRow{.design = plan_.row.id,
                     .step = number,
                     .iteration = step.iteration,
                     .pair = step.pair,
                     .marker = step.marker,
                     .evaluated = static_cast<std::int64_t>(step.evaluated.size()),
                     .alive_before = step.alive_before,
                     .alive_after = step.alive_after,
                     .best = candidate(step.best),
                     .mean_best = best_mean_,
                     .used = used_,
                     .statistic = step.statistic,
                     .p_value = step.p_value,
                     .kendall_w = step.kendall_w,
                     .spearman_rho = step.spearman_rho,
                     .qvar = step.qvar,
                     .digest = step.digest},
         rows);
  for (const Elimination& elimination : step.eliminations) {
    alive_.erase(elimination.configuration);
    record(EliminationRow{.candidate = candidate(elimination.configuration),
                          .iteration = step.iteration,
                          .step = number,
                          .rank_sum = elimination.rank_sum,
                          .reason =
                              elimination.reason == EliminationReason::Test ? "test" : "rejected"},
           rows);
  }
  record_state(rows);
  if (steps_ < stored_.step_digests.size() && stored_.step_digests[steps_] != step.digest) {
    return Unexpected(other_way());
  }
  ++steps_;
  return {};
}

/// Of the step that would come next.
Error DesignRunner::other_way() const {
  return {ErrorKind::Corrupt,
          "the race, replayed from the stored scores, takes another way than the store has: the "
          "store was written by another version of the engine, or is damaged. Keep the file, and "
          "run the campaign into a new store",
          to_string(plan_.row.id) + ", step " + std::to_string(steps_ + 1)};
}

void DesignRunner::record_consumed(const RaceStep& step, std::vector<Row>& rows) {
  for (const std::int64_t configuration : step.evaluated) {
    std::size_t position = consumed_;
    while (position < batch_.size() && (batch_[position].configuration != configuration ||
                                        batch_[position].pair != step.pair)) {
      ++position;
    }
    SWARMSMITH_ASSERT(position < batch_.size(), "a race uses what it asked for, in that order");
    record_unused(position, rows);
    consumed_ = position + 1;
    if (costs_[position] == kRejected) continue;
    const double score = to_score(costs_[position]);
    Totals& totals = totals_[static_cast<std::size_t>(configuration - 1)];
    totals.runs += 1;
    totals.score_sum += score;
    totals.score_squares += score * score;
    record(CandidateTotalsRow{.candidate = candidate(configuration),
                              .runs = totals.runs,
                              .score_sum = totals.score_sum,
                              .score_squares = totals.score_squares},
           rows);
  }
}

void DesignRunner::record_unused(std::size_t until, std::vector<Row>& rows) {
  for (; consumed_ < until; ++consumed_) {
    const StoredScore& score = scores_[consumed_];
    unused_.emplace(swarmsmith::key_of(score.key), score);
    record(UnusedRow{score.key}, rows);
  }
}

void DesignRunner::record_iteration_end(const IterationEnded& ended, std::vector<Row>& rows) {
  std::set<std::int64_t> elites;
  std::int64_t rank = 0;
  for (const Elite& elite : ended.elites) {
    elites.insert(elite.configuration);
    record(EliteRow{.design = plan_.row.id,
                    .iteration = ended.iteration,
                    .rank = ++rank,
                    .candidate = candidate(elite.configuration),
                    .mean = to_score(elite.mean),
                    .runs = elite.n},
           rows);
  }
  for (const std::int64_t number : alive_) {
    if (elites.contains(number)) continue;
    record(EliminationRow{.candidate = candidate(number),
                          .iteration = ended.iteration,
                          .step = static_cast<std::int64_t>(steps_),
                          .reason = "not kept"},
           rows);
  }
  alive_ = std::move(elites);
  if (!ended.elites.empty()) {
    best_ = ended.elites.front().configuration;
    best_mean_ = to_score(ended.elites.front().mean);
  }
  record_state(rows);
}

void DesignRunner::record_state(std::vector<Row>& rows) {
  record(DesignStateRow{.design = plan_.row.id,
                        .state = state_,
                        .used = used_,
                        .iteration = iteration_,
                        .best = candidate(best_),
                        .best_mean = best_mean_,
                        .reason = reason_},
         rows);
}

void DesignRunner::record(Row row, std::vector<Row>& rows) const {
  if (steps_ < stored_.step_digests.size()) return;
  rows.push_back(std::move(row));
}

}  // namespace swarmsmith
