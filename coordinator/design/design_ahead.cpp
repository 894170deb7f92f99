#include <algorithm>

#include "coordinator/design/design_runner.h"

namespace swarmsmith {

void DesignRunner::look_ahead(std::size_t count, std::int64_t pairs, std::vector<Task>& tasks,
                              std::vector<Row>& rows) {
  if (state_ != DesignState::Racing) return;
  if (pairs > next_pairs_) {
    next_ = race_->ahead(pairs);
    next_pairs_ = pairs;
  }
  for (; count > 0 && next_seen_ < next_.size(); ++next_seen_) {
    const Experiment& experiment = next_[next_seen_];
    if (experiment.pair > pairs_known_) {
      pairs_known_ = experiment.pair;
      record_pair(Purpose::Race, experiment, rows);
    }
    const std::uint64_t packed = key_of(experiment.configuration, experiment.pair);
    if (is_known_or_out(packed)) continue;
    const EvaluationKey key{candidate(experiment.configuration), Purpose::Race, experiment.pair};
    ahead_.emplace(packed, Ahead{key, experiment.bound, false});
    tasks.push_back(task_of(key, experiment));
    tasks.back().ahead = true;
    --count;
  }
}

/// What was dropped may still be run by somebody, so that it is not given again either.
bool DesignRunner::is_known_or_out(std::uint64_t packed) const {
  return unused_.contains(packed) || stored_.race_scores.contains(packed) ||
         ahead_.contains(packed);
}

void DesignRunner::keep_ahead(const Outcome& outcome, double bound, std::vector<Row>& rows) {
  unused_.emplace(packed_key(outcome.key), StoredScore{outcome.key, outcome.status, outcome.score,
                                                       outcome.state_digest, outcome.time, bound});
  rows.emplace_back(evaluation_row(outcome, 0, bound, plan_.source));
}

void DesignRunner::drop_void() {
  next_.clear();
  next_pairs_ = 0;
  next_seen_ = 0;
  if (ahead_.empty()) return;
  const std::vector<std::int64_t> alive = race_->alive();
  for (auto& [packed, task] : ahead_) {
    if (task.dropped || std::ranges::binary_search(alive, number_of(task.key.candidate))) continue;
    task.dropped = true;
    dropped_.push_back(task.key);
  }
}

std::vector<std::pair<EvaluationKey, double>> DesignRunner::outstanding() const {
  std::vector<std::pair<EvaluationKey, double>> tasks;
  for (const auto& [packed, task] : ahead_)
    tasks.emplace_back(task.key, task.bound);
  return tasks;
}

}  // namespace swarmsmith
