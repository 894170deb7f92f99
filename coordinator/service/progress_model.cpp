#include "coordinator/service/progress_model.h"

#include <algorithm>
#include <variant>

#include "base/overloaded.h"

namespace swarmsmith {
namespace {

bool has_ended(const DesignProgress& progress) {
  return is_over(progress.state);
}

/// A design that is over has used what it will use; what its budget had left does not count.
std::int64_t share_of(const DesignProgress& progress) {
  const bool raced = has_ended(progress) || progress.state == DesignState::Testing;
  return raced ? progress.design.budget
               : std::min(progress.used + progress.in_step,
                          std::max(progress.used, progress.design.budget));
}

}  // namespace

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
          .budget = progress.design.budget};
}

std::string stage_of(const DesignProgress& progress) {
  return progress.search ? stage_text(*progress.search, point_of(progress)) : "";
}

std::string_view shown_state(const DesignProgress& progress, DesignState state) {
  if (!progress.search || state != DesignState::Racing) return word_of(state);
  return words_of(progress.search->kind).at_work;
}

ProgressModel::ProgressModel(std::span<const DesignRow> designs, bool costs,
                             const Searches& searches)
    : costs_(costs) {
  for (const DesignRow& row : designs)
    designs_[row.id].design = row;
  for (const auto& [id, search] : searches)
    designs_.at(id).search = search;
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
    // What was evaluated ahead has no iteration until a step asks for it.
    progress.in_step += evaluation->key.purpose == Purpose::Race && evaluation->iteration > 0;
  } else if (const auto* state = std::get_if<DesignStateRow>(&row)) {
    add_state(progress, *state);
  } else if (const auto* command = std::get_if<CommandRow>(&row)) {
    add_command(progress, *command);
  }
}

void ProgressModel::add_command(DesignProgress& progress, const CommandRow& row) {
  if (is_of_leases(row.kind)) progress.paused = row.kind == CommandKind::Pause;
  // Its row comes twice: when it is asked for, and when it acts.
  if (row.kind != CommandKind::Extend || !row.step || !extensions_.insert(row.number).second)
    return;
  progress.design.budget += row.budget;
  ++progress.extensions;
}

void ProgressModel::add_state(DesignProgress& progress, const DesignStateRow& row) {
  progress.state = row.state;
  progress.used = row.used;
  progress.in_step = 0;
  progress.iteration = row.iteration;
  if (!row.best || row.used == 0) return;  // no race has said how good it is
  progress.best = row.best;
  progress.best_mean = row.best_mean;
}

std::int64_t ProgressModel::finished() const {
  std::int64_t count = 0;
  for (const auto& [id, progress] : designs_)
    count += progress.state == DesignState::Finished;
  return count;
}

std::int64_t ProgressModel::paused() const {
  std::int64_t count = 0;
  for (const auto& [id, progress] : designs_)
    count += progress.paused && !has_ended(progress);
  return count;
}

bool ProgressModel::is_over() const {
  return current() == nullptr || has_ended(*current());
}

std::int64_t ProgressModel::used() const {
  std::int64_t sum = 0;
  for (const auto& [id, progress] : designs_)
    sum += share_of(progress);
  return sum;
}

std::int64_t ProgressModel::budget() const {
  std::int64_t sum = 0;
  for (const auto& [id, progress] : designs_)
    sum += progress.design.budget;
  return sum;
}

const DesignProgress* ProgressModel::current() const {
  for (const auto& [id, progress] : designs_) {
    if (!has_ended(progress)) return &progress;
  }
  return designs_.empty() ? nullptr : &designs_.rbegin()->second;
}

}  // namespace swarmsmith
