#include "coordinator/design/ahead_tasks.h"

#include <algorithm>

#include "base/assert.h"
#include "coordinator/design/known_scores.h"

namespace swarmsmith {

void AheadTasks::expect(std::vector<Experiment> experiments, std::int64_t pairs) {
  expected_ = std::move(experiments);
  pairs_ = pairs;
}

const Experiment* AheadTasks::next() {
  // Each experiment once in a step, also if `expect` has made the list longer meanwhile.
  return seen_ < expected_.size() ? &expected_[seen_++] : nullptr;
}

void AheadTasks::add(const EvaluationKey& key, double bound) {
  tasks_.emplace(packed_key(key), Ahead{key, bound, false});
}

bool AheadTasks::contains(const EvaluationKey& key) const {
  return tasks_.contains(packed_key(key));
}

std::optional<double> AheadTasks::remove(const EvaluationKey& key) {
  const auto task = tasks_.extract(packed_key(key));
  return task ? std::optional(task.mapped().bound) : std::nullopt;
}

void AheadTasks::want(const EvaluationKey& key) {
  // A drop that was not taken yet is withdrawn: the coordinator would delete a task that is wanted.
  if (remove(key)) std::erase(dropped_, key);
}

void AheadTasks::end_step(std::span<const std::int64_t> alive) {
  SWARMSMITH_ASSERT(std::ranges::is_sorted(alive), "binary search needs ascending order");
  expected_.clear();
  pairs_ = 0;
  seen_ = 0;
  for (auto& [packed, task] : tasks_) {
    // The race may still ask for tasks of candidates that are alive.
    if (task.dropped || std::ranges::binary_search(alive, number_of(task.key.candidate))) continue;
    task.dropped = true;
    dropped_.push_back(task.key);
  }
}

void AheadTasks::drop_all() {
  for (auto& [packed, task] : tasks_) {
    if (!std::exchange(task.dropped, true)) dropped_.push_back(task.key);
  }
}

std::vector<std::pair<EvaluationKey, double>> AheadTasks::outstanding() const {
  std::vector<std::pair<EvaluationKey, double>> tasks;
  for (const auto& [packed, task] : tasks_)
    tasks.emplace_back(task.key, task.bound);
  return tasks;
}

}  // namespace swarmsmith
