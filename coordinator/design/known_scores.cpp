#include "coordinator/design/known_scores.h"

#include <utility>

#include "base/assert.h"

namespace swarmsmith {
namespace {

template <class Design>
auto& asked_scores_of(Design& stored, Purpose purpose) {
  auto* scores = scores_of(stored, purpose);
  SWARMSMITH_ASSERT(
      scores != nullptr,
      "a design asks for runs of its race and its tests, and for calls of a targetEvaluator");
  return *scores;
}

}  // namespace

const StoredScore* KnownScores::stored(const EvaluationKey& key) const {
  const auto& scores = asked_scores_of(stored_, key.purpose);
  const auto found = scores.find(packed_key(key));
  return found == scores.end() ? nullptr : &found->second;
}

std::optional<StoredScore> KnownScores::take(const EvaluationKey& key) {
  const std::uint64_t packed = packed_key(key);
  // A score that is asked for leaves the stored ones. The rest was never asked for; if such a score
  // counts in the store, `verify` reports it.
  if (auto score = asked_scores_of(stored_, key.purpose).extract(packed)) {
    if (is_of_tests(key.purpose)) return tested_.insert(std::move(score)).position->second;
    return score.mapped();
  }
  // Computed ahead, or wanted by the race before and not used.
  if (key.purpose == Purpose::Race) {
    if (const auto score = unused_.extract(packed)) return score.mapped();
  }
  if (is_of_tests(key.purpose)) {
    if (const auto found = tested_.find(packed); found != tested_.end()) return found->second;
  }
  return std::nullopt;
}

void KnownScores::keep(StoredScore score) {
  SWARMSMITH_ASSERT(score.key.purpose != Purpose::Evaluator,
                    "a targetEvaluator is asked again, since others are alive");
  const std::uint64_t packed = packed_key(score.key);
  // No iteration uses it now; the race sets it when it asks again.
  score.iteration = 0;
  (score.key.purpose == Purpose::Race ? unused_ : tested_).emplace(packed, score);
}

bool KnownScores::contains(const EvaluationKey& key) const {
  const std::uint64_t packed = packed_key(key);
  return unused_.contains(packed) || stored_.race_scores.contains(packed);
}

std::set<EvaluationKey> KnownScores::discard_race() {
  std::set<EvaluationKey> keys;
  for (const auto& [packed, score] : stored_.race_scores)
    keys.insert(score.key);
  stored_.race_scores.clear();
  return keys;
}

}  // namespace swarmsmith
