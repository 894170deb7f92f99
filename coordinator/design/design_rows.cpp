#include <algorithm>
#include <utility>

#include "base/assert.h"
#include "base/overloaded.h"
#include "base/text/toml_text.h"
#include "coordinator/design/design_runner.h"
#include "programs/cost.h"

namespace swarmsmith {

namespace {

std::string reason_text(EliminationReason reason) {
  switch (reason) {
    case EliminationReason::Test:
      return "test";
    case EliminationReason::Rejection:
      return "rejected";
    case EliminationReason::Capping:
      break;
  }
  return "capping";
}

}  // namespace

Expected<void> DesignRunner::record_events(std::vector<Row>& rows) {
  for (const RaceEvent& event : race_->take_events()) {
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
                              [&](const TimeEstimated& estimated) -> Expected<void> {
                                record_estimate(estimated, rows);
                                return {};
                              },
                              [&](const RaceWarning& warning) -> Expected<void> {
                                warn(warning.text, rows);
                                return {};
                              },
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
  SWARMSMITH_ASSERT(sampled.id > static_cast<std::int64_t>(totals_.size()),
                    "configurations are numbered in the order of their creation");
  // Given ones that are forbidden have a number and nothing else.
  totals_.resize(static_cast<std::size_t>(sampled.id));
  if (plan_.scenario.target_evaluator) judged_.resize(totals_.size());
  CandidateText text = plan_.describe(sampled.configuration);
  calls_of_[sampled.id] = text.call;
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
                      .postselection = started.postselection,
                      .model_digest = started.model_digest},
         rows);
}

Expected<void> DesignRunner::record_step(const RaceStep& step, std::vector<Row>& rows) {
  reported_ = true;
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
                     .bound = step.bound,
                     .digest = step.digest},
         rows);
  // The race after the last takes candidates from anywhere.
  for (const auto& [configuration, pair] : step.evaluated)
    alive_.insert(configuration);
  for (const Elimination& elimination : step.eliminations) {
    alive_.erase(elimination.configuration);
    record(EliminationRow{.candidate = candidate(elimination.configuration),
                          .iteration = step.iteration,
                          .step = number,
                          .rank_sum = elimination.rank_sum,
                          .reason = reason_text(elimination.reason)},
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
  if (plan_.scenario.target_evaluator) return record_judged(rows);
  for (const auto& [configuration, pair] : step.evaluated)
    consume(configuration, pair, rows);
}

void DesignRunner::consume(std::int64_t configuration, std::int64_t pair, std::vector<Row>& rows) {
  std::size_t position = consumed_;
  while (position < given_.size() &&
         (given_[position].configuration != configuration || given_[position].pair != pair)) {
    ++position;
  }
  SWARMSMITH_ASSERT(position < given_.size(), "a race uses what it asked for, in that order");
  record_unused(position, rows);
  consumed_ = position + 1;
  const StoredScore& given = given_[position].score;
  if (given.status != EvaluationStatus::Ok) return;
  const double score = to_score(to_cost(given.score));
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

void DesignRunner::record_judged(std::vector<Row>& rows) {
  for (std::size_t i = 0; i < batch_.size(); ++i) {
    if (!batch_[i].is_evaluation || scores_[i].status != EvaluationStatus::Ok) continue;
    const std::int64_t number = batch_[i].configuration;
    auto& by_pair = judged_[static_cast<std::size_t>(number - 1)];
    by_pair[batch_[i].pair] = to_score(measurements_[i].cost);
    CandidateTotalsRow totals{.candidate = candidate(number)};
    for (const auto& [pair, score] : by_pair) {
      totals.runs += 1;
      totals.score_sum += score;
      totals.score_squares += score * score;
    }
    record(totals, rows);
  }
}

void DesignRunner::record_estimate(const TimeEstimated& estimated, std::vector<Row>& rows) {
  reported_ = true;
  // After races there is nothing to count; their steps were.
  if (!estimated.evaluated.empty() && plan_.scenario.target_evaluator) record_judged(rows);
  if (!plan_.scenario.target_evaluator) {
    for (const auto& [configuration, pair] : estimated.evaluated)
      consume(configuration, pair, rows);
  }
  used_ = estimated.runs;
  record(EventRow{.severity = "info",
                  .kind = "time estimated",
                  .text = "{\"design\":" + quoted_text(to_string(plan_.row.id)) +
                          ",\"runs\":" + std::to_string(estimated.runs) +
                          ",\"time\":" + number_text(estimated.used) +
                          ",\"mean\":" + number_text(estimated.mean_time) +
                          ",\"remaining\":" + std::to_string(estimated.remaining) +
                          ",\"bound_max\":" + number_text(estimated.bound_max) + "}"},
         rows);
  if (!estimated.evaluated.empty()) record_state(rows);
}

void DesignRunner::record_unused(std::size_t until, std::vector<Row>& rows) {
  for (; consumed_ < until; ++consumed_) {
    StoredScore& score = given_[consumed_].score;
    score.iteration = 0;
    unused_.emplace(packed_key(score.key), score);
    record(UnusedRow{score.key}, rows);
  }
}

void DesignRunner::record_use(const StoredScore& score, std::vector<Row>& rows) const {
  if (score.iteration != 0) return;
  record(EvaluationRow{.key = score.key,
                       .iteration = std::max<std::int64_t>(1, iteration_),
                       .status = score.status,
                       .score = score.score,
                       .state_digest = score.state_digest,
                       .time = score.time,
                       .bound = score.bound,
                       .source = plan_.source},
         rows);
}

void DesignRunner::record_iteration_end(const IterationEnded& ended, std::vector<Row>& rows) {
  std::set<std::int64_t> elites;
  elites_.emplace_back();
  std::int64_t rank = 0;
  for (const Elite& elite : ended.elites) {
    elites.insert(elite.configuration);
    elites_.back().push_back(elite.configuration);
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
  forget_losers();
  if (!ended.elites.empty()) {
    best_ = ended.elites.front().configuration;
    best_mean_ = to_score(ended.elites.front().mean);
  }
  record_state(rows);
}

/// What a race needs is kept of the elites alone: memory does not grow with the budget.
void DesignRunner::forget_losers() {
  std::erase_if(calls_of_, [&](const auto& known) { return !alive_.contains(known.first); });
  passed_ = PassedCandidates{.design = id(),
                             .before = candidate(static_cast<std::int64_t>(totals_.size()) + 1)};
  for (const std::int64_t number : alive_)
    passed_->kept.push_back(candidate(number));
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
