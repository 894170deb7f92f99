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

/// The experiments that the design waits for, in the search's order: a batch of the race, or the
/// tests. After `put` or `await`, an experiment either has a score or is awaited, never both.
class Batch {
 public:
  Batch() = default;
  /// No experiment has a score or is awaited yet.
  explicit Batch(std::vector<Experiment> experiments);

  void put(std::size_t position, const StoredScore& score);
  void await(std::size_t position, const EvaluationKey& key);
  /// The outcome of an awaited experiment has come; returns its score.
  StoredScore answer(const Outcome& outcome);

  /// Stops awaiting an experiment; false if it was not awaited.
  bool let_go(const EvaluationKey& key);
  /// Stops awaiting all experiments; returns those that were awaited.
  std::vector<Experiment> let_go();

  std::span<const Experiment> experiments() const { return experiments_; }
  /// By experiment; an entry without a candidate has no score yet.
  std::span<const StoredScore> scores() const { return scores_; }
  /// By experiment, in the form that a search takes: costs, infinite for rejected experiments.
  std::vector<Measurement> measurements() const;
  std::size_t n_awaited() const { return awaited_.size(); }
  bool is_complete() const { return awaited_.empty(); }

 private:
  std::vector<Experiment> experiments_;
  std::vector<StoredScore> scores_;                         ///< by experiment
  std::unordered_map<std::uint64_t, std::size_t> awaited_;  ///< position by key
};

/// The score of an outcome in the form in which a store returns it.
StoredScore score_of(const Outcome& outcome, double bound);

}  // namespace swarmsmith
