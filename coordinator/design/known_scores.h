#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <unordered_map>
#include <vector>

#include "storage/stored_enums.h"

namespace swarmsmith {

/// Identifies an evaluation among those of the same design and purpose.
constexpr std::uint64_t packed_key(const EvaluationKey& key) {
  return (static_cast<std::uint64_t>(number_of(key.candidate)) << 32U) |
         static_cast<std::uint64_t>(key.pair);
}

/// The stored data of one design, for a replay; scores by `packed_key`.
struct StoredDesign {
  std::unordered_map<std::uint64_t, StoredScore> race_scores;
  /// Includes the runs under further profiles, whose pairs have other numbers.
  std::unordered_map<std::uint64_t, StoredScore> test_scores;
  /// Scores of a targetEvaluator; their pairs are task numbers.
  std::unordered_map<std::uint64_t, StoredScore> evaluator_scores;
  /// The digest of step n is at index n - 1.
  std::vector<std::uint64_t> step_digests;
};

/// The map for scores of this purpose; null for a purpose that no design asks for.
template <class Design>
auto* scores_of(Design& design, Purpose purpose) {
  using Replay = PurposeFacts::Replay;
  const auto facts = facts_of(purpose);
  switch (facts ? facts->replay : Replay::None) {
    case Replay::Race:
      return &design.race_scores;
    case Replay::Tests:
      return &design.test_scores;
    case Replay::Evaluator:
      return &design.evaluator_scores;
    case Replay::None:
      break;
  }
  return decltype(&design.race_scores)(nullptr);
}

/// Scores that exist before a design asks for them. A score of the race is either here or in the
/// race, never in both: `take` moves it to the race, and `keep` returns it if the race did not use
/// it. A score of a test stays here after it was taken: a candidate that is tested again after an
/// extension is not run again.
class KnownScores {
 public:
  explicit KnownScores(StoredDesign stored) : stored_(std::move(stored)) {}

  /// A stored score that was not asked for; null if there is none.
  const StoredScore* stored(const EvaluationKey& key) const;
  /// The score, if it is known. Scores of the race are handed over.
  std::optional<StoredScore> take(const EvaluationKey& key);
  /// Adds a score of the race that no iteration uses, or a score of a test.
  void keep(StoredScore score);
  /// Whether `take` would return a score of the race for this key.
  bool contains(const EvaluationKey& key) const;
  /// Deletes the stored scores of the race; returns their keys.
  std::set<EvaluationKey> discard_race();

  /// Stored scores that were not asked for (yet), including those that were computed ahead.
  const StoredDesign& unasked() const { return stored_; }

 private:
  StoredDesign stored_;
  /// Scores of the race that were computed ahead, or were wanted by it and not used.
  std::unordered_map<std::uint64_t, StoredScore> unused_;
  std::unordered_map<std::uint64_t, StoredScore> tested_;
};

}  // namespace swarmsmith
