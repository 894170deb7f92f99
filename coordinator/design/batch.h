#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "coordinator/design/task.h"
#include "irace_core/experiment.h"
#include "storage/rows.h"

namespace swarmsmith {

/// What is waited for, in the search's order: a batch of the race, or the tests. Each experiment
/// that was put or awaited has a score or is awaited, never both.
class Batch {
 public:
  Batch() = default;
  /// Nothing is put or awaited yet.
  explicit Batch(std::vector<Experiment> experiments);

  void put(std::size_t position, const StoredScore& score);
  void await(std::size_t position, const EvaluationKey& key);
  /// The outcome of one that is awaited; its score.
  StoredScore answer(const Outcome& outcome);

  /// It is no longer awaited; false when it was not.
  bool let_go(const EvaluationKey& key);
  /// Nothing is awaited any more; what was.
  std::vector<Experiment> let_go();

  std::span<const Experiment> experiments() const { return experiments_; }
  /// By experiment; without a candidate where none is there.
  std::span<const StoredScore> scores() const { return scores_; }
  /// By experiment, as a search takes them: costs, infinite for those that were rejected.
  std::vector<Measurement> measurements() const;
  std::size_t n_awaited() const { return awaited_.size(); }
  bool is_complete() const { return awaited_.empty(); }

 private:
  std::vector<Experiment> experiments_;
  std::vector<StoredScore> scores_;                         ///< by experiment
  std::unordered_map<std::uint64_t, std::size_t> awaited_;  ///< position by key
};

/// The score of an evaluation that was made, as a store gives it back.
StoredScore score_of(const Outcome& outcome, double bound);

}  // namespace swarmsmith
