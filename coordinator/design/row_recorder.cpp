#include "coordinator/design/row_recorder.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/assert.h"
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

EvaluationRow evaluation_row(const Outcome& outcome, std::int64_t iteration, double bound,
                             const std::string& source) {
  return {.key = outcome.key,
          .iteration = iteration,
          .status = outcome.status,
          .measured = outcome.measured,
          .bound = bound,
          .source = source,
          .worker = outcome.worker,
          .attempt = outcome.attempt};
}

RowRecorder::RowRecorder(DesignId design, std::string source,
                         std::vector<std::uint64_t> step_digests)
    : design_{.design = design},
      source_(std::move(source)),
      step_digests_(std::move(step_digests)),
      totals_(design) {}

void RowRecorder::record_state() {
  record(design_);
}

void RowRecorder::record_candidate(const ConfigurationSampled& sampled, CandidateText text) {
  // Given configurations that are forbidden get a number, but no row.
  totals_.add_up_to(sampled.id);
  alive_.insert(sampled.id);
  record(CandidateRow{.id = candidate(sampled.id),
                      .iteration = sampled.iteration,
                      .parent = candidate(sampled.parent),
                      .parameters = std::move(text.parameters),
                      .machine = std::move(text.machine),
                      .modules = std::move(text.modules),
                      .states = text.states,
                      .transitions = text.transitions});
}

void RowRecorder::record_iteration(const IterationStarted& started) {
  design_.iteration = started.iteration;
  record(IterationRow{.design = design_.design,
                      .number = started.iteration,
                      .of = started.n_iterations,
                      .budget = started.budget,
                      .configurations = started.n_configurations,
                      .elites = static_cast<std::int64_t>(started.elites.size()),
                      .soft_restart = started.soft_restart,
                      .postselection = started.postselection,
                      .model_digest = started.model_digest});
}

Expected<void> RowRecorder::record_step(const RaceStep& step) {
  SWARMSMITH_ASSERT(step.experiments_used >= design_.used, "the experiments used never decrease");
  design_.used = step.experiments_used;
  design_.best = candidate(step.best);
  design_.best_mean = to_score(step.mean_best);
  record(RaceStepRow{.design = design_.design,
                     .step = steps() + 1,
                     .iteration = step.iteration,
                     .pair = step.pair,
                     .marker = step.marker,
                     .evaluated = static_cast<std::int64_t>(step.evaluated.size()),
                     .alive_before = step.alive_before,
                     .alive_after = step.alive_after,
                     .best = design_.best,
                     .mean_best = design_.best_mean,
                     .used = design_.used,
                     .statistic = step.statistic,
                     .p_value = step.p_value,
                     .kendall_w = step.kendall_w,
                     .spearman_rho = step.spearman_rho,
                     .qvar = step.qvar,
                     .bound = step.bound,
                     .digest = step.digest});
  // The race after the last iteration may use candidates of any iteration.
  for (const auto& [configuration, pair] : step.evaluated)
    alive_.insert(configuration);
  for (const Elimination& elimination : step.eliminations) {
    alive_.erase(elimination.configuration);
    record(EliminationRow{.candidate = candidate(elimination.configuration),
                          .iteration = step.iteration,
                          .step = steps() + 1,
                          .rank_sum = elimination.rank_sum,
                          .reason = reason_text(elimination.reason)});
  }
  record_state();
  // Resume is replay (decision 3): a different step means that the store was written by another
  // engine, or was changed, and the race must not continue from it.
  if (is_replaying() && step_digests_[steps_] != step.digest) return Unexpected(other_step());
  ++steps_;
  return {};
}

void RowRecorder::record_end(const IterationEnded& ended) {
  std::set<std::int64_t> elites;
  std::int64_t rank = 0;
  for (const Elite& elite : ended.elites) {
    elites.insert(elite.configuration);
    record(EliteRow{.design = design_.design,
                    .iteration = ended.iteration,
                    .rank = ++rank,
                    .candidate = candidate(elite.configuration),
                    .mean = to_score(elite.mean),
                    .runs = elite.n});
  }
  // Survivors of the race that are not among its elites (irace facts, 13).
  for (const std::int64_t number : alive_) {
    if (elites.contains(number)) continue;
    record(EliminationRow{.candidate = candidate(number),
                          .iteration = ended.iteration,
                          .step = steps(),
                          .reason = "not kept"});
  }
  // The next race begins with them.
  alive_ = std::move(elites);
  if (!ended.elites.empty()) {
    design_.best = candidate(ended.elites.front().configuration);
    design_.best_mean = to_score(ended.elites.front().mean);
  }
  record_state();
}

void RowRecorder::record_estimate(const TimeEstimated& estimated) {
  design_.used = estimated.runs;
  record(event_row("info", "time estimated",
                   {{"design", to_string(design_.design)},
                    {"runs", estimated.runs},
                    {"time", estimated.used},
                    {"mean", estimated.mean_time},
                    {"remaining", estimated.remaining},
                    {"bound_max", estimated.bound_max}}));
  // After races there is nothing to count here, because their steps are counted already.
  if (!estimated.evaluated.empty()) record_state();
}

void RowRecorder::record_warning(std::string_view text) {
  record(event_row("warning", "race",
                   {{"design", to_string(design_.design)}, {"text", std::string(text)}}));
}

void RowRecorder::record_command(CommandRow command) {
  record(std::move(command));
}

void RowRecorder::record_pair(Purpose purpose, const Experiment& experiment) {
  std::int64_t& last = pairs_[purpose];
  // Experiments of one pair follow each other, and a pair that was looked at ahead has its row
  // already.
  if (experiment.pair <= last) return;
  last = experiment.pair;
  record(PairRow{.design = design_.design,
                 .purpose = purpose,
                 .number = experiment.pair,
                 .instance = experiment.instance,
                 .seed = experiment.seed});
}

void RowRecorder::record_use(const StoredScore& score) {
  // It is a part of the race already.
  if (score.iteration != 0) return;
  record(EvaluationRow{.key = score.key,
                       .iteration = counted_iteration(),
                       .status = score.status,
                       .measured = score.measured,
                       .bound = score.bound,
                       .source = source_});
}

void RowRecorder::record_unused(const EvaluationKey& key) {
  record(UnusedRow{key});
}

void RowRecorder::record_run(std::int64_t number, double score) {
  record(totals_.add_run(number, score));
}

void RowRecorder::record_judged(std::int64_t number, std::int64_t pair, double score) {
  record(totals_.judge(number, pair, score));
}

Error RowRecorder::other_step() const {
  return {ErrorKind::Corrupt,
          "the race, replayed from the stored scores, differs from the stored race: another "
          "version of the engine wrote the store, or it is damaged. Keep the file, and "
          "run the campaign into a new store",
          to_string(design_.design) + ", step " + std::to_string(steps_ + 1)};
}

std::int64_t RowRecorder::counted_iteration() const {
  return std::max<std::int64_t>(1, design_.iteration);
}

CandidateId RowRecorder::candidate(std::int64_t number) const {
  return number > 0 ? candidate_id(design_.design, number) : CandidateId{};
}

void RowRecorder::move_rows_to(std::vector<Row>& rows) {
  std::ranges::move(rows_, std::back_inserter(rows));
  rows_.clear();
}

void RowRecorder::record(Row row) {
  // The rows up to the last stored step are in the store already.
  if (!is_replaying()) rows_.push_back(std::move(row));
}

}  // namespace swarmsmith
