#include "coordinator/cli/progress_model.h"

#include <variant>

namespace swarmsmith::cli {
namespace {

/// A finished design has used what it will use; what its budget had left does not count.
std::int64_t share_of(const DesignProgress& progress) {
  const bool over = progress.state == DesignState::Finished ||
                    progress.state == DesignState::Testing;
  return over ? progress.design.budget : progress.used;
}

}  // namespace

ProgressModel::ProgressModel(std::span<const DesignRow> designs) {
  for (const DesignRow& row : designs) designs_[row.id].design = row;
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
    progress.best = step->best;
    progress.best_mean = step->mean_best;
  } else if (const auto* state = std::get_if<DesignStateRow>(&row)) {
    add_state(*state);
  }
}

void ProgressModel::add_state(const DesignStateRow& row) {
  DesignProgress& progress = designs_.at(row.design);
  progress.state = row.state;
  progress.used = row.used;
  progress.iteration = row.iteration;
  if (!row.best) return;
  progress.best = row.best;
  progress.best_mean = row.best_mean;
}

std::int64_t ProgressModel::finished() const {
  std::int64_t count = 0;
  for (const auto& [id, progress] : designs_) count += progress.state == DesignState::Finished;
  return count;
}

std::int64_t ProgressModel::used() const {
  std::int64_t sum = 0;
  for (const auto& [id, progress] : designs_) sum += share_of(progress);
  return sum;
}

std::int64_t ProgressModel::budget() const {
  std::int64_t sum = 0;
  for (const auto& [id, progress] : designs_) sum += progress.design.budget;
  return sum;
}

const DesignProgress* ProgressModel::current() const {
  for (const auto& [id, progress] : designs_) {
    if (progress.state != DesignState::Finished) return &progress;
  }
  return designs_.empty() ? nullptr : &designs_.rbegin()->second;
}

}  // namespace swarmsmith::cli
