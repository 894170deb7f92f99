#include "cli/output/progress_model.h"

#include <algorithm>
#include <variant>

#include "cli/output/progress_text.h"
#include "programs/cost.h"

namespace swarmsmith::cli {
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

ProgressModel::ProgressModel(std::span<const DesignRow> designs, bool costs) : costs_(costs) {
  for (const DesignRow& row : designs)
    designs_[row.id].design = row;
}

std::string ProgressModel::mean_text(double score) const {
  return score_text(costs_ ? to_cost(score) : score);
}

void ProgressModel::add(const Row& row) {
  if (const auto* iteration = std::get_if<IterationRow>(&row)) {
    DesignProgress& progress = designs_.at(iteration->design);
    progress.iteration = iteration->number;
    progress.iterations = iteration->of;
    progress.configurations = iteration->configurations;
    progress.alive = iteration->configurations;
  } else if (const auto* step = std::get_if<RaceStepRow>(&row)) {
    DesignProgress& progress = designs_.at(step->design);
    progress.state = DesignState::Racing;
    progress.alive = step->alive_after;
    progress.used = step->used;
    progress.in_step = 0;
    progress.best = step->best;
    progress.best_mean = step->mean_best;
  } else if (const auto* evaluation = std::get_if<EvaluationRow>(&row)) {
    // What was evaluated ahead has no iteration until a step asks for it.
    if (evaluation->key.purpose == Purpose::Race && evaluation->iteration > 0)
      ++designs_.at(design_of(evaluation->key.candidate)).in_step;
  } else if (const auto* state = std::get_if<DesignStateRow>(&row)) {
    add_state(*state);
  } else if (const auto* command = std::get_if<CommandRow>(&row)) {
    add_command(*command);
  }
}

void ProgressModel::add_command(const CommandRow& row) {
  DesignProgress& progress = designs_.at(row.design);
  if (is_of_leases(row.kind)) progress.paused = row.kind == CommandKind::Pause;
  // Its row comes twice: when it is asked for, and when it acts.
  if (row.kind != CommandKind::Extend || !row.step || !extensions_.insert(row.number).second)
    return;
  progress.design.budget += row.budget;
}

void ProgressModel::add_state(const DesignStateRow& row) {
  DesignProgress& progress = designs_.at(row.design);
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

}  // namespace swarmsmith::cli
