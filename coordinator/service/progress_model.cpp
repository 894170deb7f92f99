#include "coordinator/service/progress_model.h"

#include <algorithm>
#include <variant>

#include "base/overloaded.h"

namespace swarmsmith {
namespace {

bool is_raced(DesignState state) {
  return is_over(state) || state == DesignState::Testing;
}

}  // namespace

std::int64_t DesignStatus::left() const {
  return is_raced(state) ? 0 : std::max<std::int64_t>(0, budget - used);
}

void CampaignTotals::add(const DesignStatus& design) {
  ++designs;
  finished += design.state == DesignState::Finished;
  stopped += design.state == DesignState::Stopped;
  paused += design.paused && !is_over(design.state);
  used += design.used;
  in_step += design.in_step;
  budget += design.budget;
  left += design.left();
}

CampaignTotals totals_of(std::span<const DesignStatus> designs) {
  CampaignTotals totals;
  for (const DesignStatus& design : designs)
    totals.add(design);
  return totals;
}

SearchPoint point_of(const DesignProgress& progress) {
  return {.iteration = progress.iteration,
          .iterations = progress.iterations,
          .finals = progress.extensions,
          .is_final = progress.is_final,
          .configurations = progress.configurations,
          .alive = progress.alive,
          .runs_wanted = progress.wanted,
          .runs = progress.used - progress.used_before + progress.in_step,
          .step = progress.step,
          .used = progress.used,
          .budget = progress.budget};
}

std::string stage_of(const DesignProgress& progress) {
  return progress.options ? stage_text(*progress.options, point_of(progress)) : "";
}

std::string_view shown_state(const DesignProgress& progress, DesignState state) {
  if (!progress.options || state != DesignState::Racing) return word_of(state);
  return words_of(*progress.options).at_work;
}

ProgressModel::ProgressModel(std::span<const DesignRow> designs, bool costs,
                             const Searches& searches)
    : costs_(costs) {
  for (const DesignRow& row : designs) {
    DesignProgress& progress = designs_[row.id];
    progress.id = row.id;
    progress.mission = row.mission;
    progress.method = row.method;
    progress.repetition = row.repetition;
    progress.budget = row.budget;
  }
  for (const auto& [id, options] : searches) {
    designs_.at(id).options = options;
    designs_.at(id).search = words_of(options).name;
  }
}

void ProgressModel::add(const Row& row) {
  const DesignId id =
      std::visit(Overloaded{[](const IterationRow& r) { return r.design; },
                            [](const RaceStepRow& r) { return r.design; },
                            [](const EvaluationRow& r) { return design_of(r.key.candidate); },
                            [](const DesignStateRow& r) { return r.design; },
                            [](const CommandRow& r) { return r.design; },
                            [](const auto&) { return DesignId{}; }},
                 row);
  if (const auto found = designs_.find(id); found != designs_.end()) add(found->second, row);
}

void ProgressModel::add(DesignProgress& progress, const Row& row) {
  if (const auto* iteration = std::get_if<IterationRow>(&row)) {
    progress.iteration = iteration->number;
    progress.iterations = iteration->of;
    progress.configurations = iteration->configurations;
    progress.alive = iteration->configurations;
    progress.is_final = iteration->postselection;
    progress.wanted = iteration->budget;
    progress.used_before = progress.used;
  } else if (const auto* step = std::get_if<RaceStepRow>(&row)) {
    progress.state = DesignState::Racing;
    progress.alive = step->alive_after;
    progress.used = step->used;
    progress.step = step->step;
    progress.in_step = 0;
    progress.best = step->best;
    progress.best_mean = step->mean_best;
  } else if (const auto* evaluation = std::get_if<EvaluationRow>(&row)) {
    // An evaluation made ahead has no iteration until a step asks for it.
    progress.in_step += evaluation->key.purpose == Purpose::Race && evaluation->iteration > 0;
    add_test(progress, *evaluation);
  } else if (const auto* state = std::get_if<DesignStateRow>(&row)) {
    add_state(progress, *state);
    tell_tests(progress);
  } else if (const auto* command = std::get_if<CommandRow>(&row)) {
    add_command(progress, *command);
  }
}

void ProgressModel::add_test(DesignProgress& progress, const EvaluationRow& row) {
  progress.has_evaluator |= row.key.purpose == Purpose::Evaluator;
  if (row.key.purpose != Purpose::Test || row.status != EvaluationStatus::Ok) return;
  TestedDesign& tested = progress.tests[row.key.candidate];
  ++tested.runs;
  // A running mean: a process that resumes gets mean and number from the store, without the scores.
  tested.mean += (row.measured.score - tested.mean) / static_cast<double>(tested.runs);
}

void ProgressModel::tell_tests(DesignProgress& progress) {
  const auto found = progress.tests.find(progress.best);
  const bool are_known = found != progress.tests.end() && !progress.has_evaluator;
  progress.test_mean = are_known ? found->second.mean : 0;
  progress.test_runs = are_known ? found->second.runs : 0;
}

void ProgressModel::add(const TestedDesign& tested) {
  const auto found = designs_.find(design_of(tested.winner));
  if (found == designs_.end()) return;
  found->second.tests[tested.winner] = tested;
  tell_tests(found->second);
}

void ProgressModel::add_command(DesignProgress& progress, const CommandRow& row) {
  if (is_of_leases(row.kind)) progress.paused = row.kind == CommandKind::Pause;
  // The row of an extension comes twice: when it is requested, and when it takes effect.
  if (row.kind != CommandKind::Extend || !row.step || !extensions_.insert(row.number).second)
    return;
  progress.budget += row.budget;
  ++progress.extensions;
}

void ProgressModel::add_state(DesignProgress& progress, const DesignStateRow& row) {
  progress.state = row.state;
  progress.used = row.used;
  progress.in_step = 0;
  progress.iteration = row.iteration;
  progress.reason = row.reason;
  if (!row.best || row.used == 0) return;  // no race has measured how good it is
  progress.best = row.best;
  progress.best_mean = row.best_mean;
}

void ProgressModel::drop_open_steps() {
  for (auto& [id, progress] : designs_)
    progress.in_step = 0;
}

CampaignTotals ProgressModel::totals() const {
  CampaignTotals totals;
  for (const auto& [id, progress] : designs_)
    totals.add(progress);
  return totals;
}

std::vector<DesignStatus> ProgressModel::designs() const {
  std::vector<DesignStatus> designs;
  designs.reserve(designs_.size());
  for (const auto& [id, progress] : designs_) {
    designs.push_back(progress);
    designs.back().paused = progress.paused && !is_over(progress.state);
    designs.back().stage = stage_of(progress);
  }
  return designs;
}

const DesignProgress* ProgressModel::current() const {
  for (const auto& [id, progress] : designs_) {
    if (!is_over(progress.state)) return &progress;
  }
  return designs_.empty() ? nullptr : &designs_.rbegin()->second;
}

}  // namespace swarmsmith
