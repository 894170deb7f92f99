#include "coordinator/design/batch.h"

#include <limits>
#include <utility>

#include "base/assert.h"
#include "coordinator/design/known_scores.h"
#include "programs/cost.h"

namespace swarmsmith {
namespace {

/// A rejection has an infinite cost, as in irace (irace facts, 12).
constexpr double kRejected = std::numeric_limits<double>::infinity();

}  // namespace

StoredScore score_of(const Outcome& outcome, double bound) {
  return {outcome.key, outcome.status, outcome.measured, bound};
}

Batch::Batch(std::vector<Experiment> experiments)
    : experiments_(std::move(experiments)), scores_(experiments_.size()) {}

void Batch::put(std::size_t position, const StoredScore& score) {
  SWARMSMITH_ASSERT(position < scores_.size(), "the position is in the batch");
  scores_[position] = score;
}

void Batch::await(std::size_t position, const EvaluationKey& key) {
  SWARMSMITH_ASSERT(position < experiments_.size(), "the position is in the batch");
  const bool is_new = awaited_.emplace(packed_key(key), position).second;
  SWARMSMITH_ASSERT(is_new, "a batch has an evaluation once: its outcome comes once");
}

StoredScore Batch::answer(const Outcome& outcome) {
  // Outcomes come in any order; the position gives each its place in the search's order, so that
  // the search does not depend on the workers (orchestration facts, 9).
  const auto found = awaited_.find(packed_key(outcome.key));
  SWARMSMITH_ASSERT(found != awaited_.end(), "an outcome comes once, and only when wanted");
  const std::size_t position = found->second;
  awaited_.erase(found);
  put(position, score_of(outcome, experiments_[position].bound));
  return scores_[position];
}

bool Batch::let_go(const EvaluationKey& key) {
  return awaited_.erase(packed_key(key)) > 0;
}

std::vector<Experiment> Batch::let_go() {
  std::vector<Experiment> left;
  for (const auto& [packed, position] : awaited_)
    left.push_back(experiments_[position]);
  awaited_.clear();
  return left;
}

std::vector<Measurement> Batch::measurements() const {
  // A search never sees a part of a batch: which part is there depends on how fast the workers
  // were.
  SWARMSMITH_ASSERT(is_complete(), "a search gets a batch as a whole");
  std::vector<Measurement> measurements;
  measurements.reserve(scores_.size());
  for (const StoredScore& score : scores_) {
    const bool is_ok = score.status == EvaluationStatus::Ok;
    measurements.push_back(
        {is_ok ? to_cost(score.measured.score) : kRejected, score.measured.time});
  }
  return measurements;
}

}  // namespace swarmsmith
