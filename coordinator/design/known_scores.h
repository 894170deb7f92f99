#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <unordered_map>
#include <vector>

#include "storage/stored_enums.h"

namespace swarmsmith {

/// Names an evaluation among those of its design and purpose.
constexpr std::uint64_t packed_key(const EvaluationKey& key) {
  return (static_cast<std::uint64_t>(number_of(key.candidate)) << 32U) |
         static_cast<std::uint64_t>(key.pair);
}

/// What a store knows of one design, for replay; scores by `packed_key`.
struct StoredDesign {
  std::unordered_map<std::uint64_t, StoredScore> race_scores;
  /// Those under further profiles have other pairs.
  std::unordered_map<std::uint64_t, StoredScore> test_scores;
  /// Of a targetEvaluator: the pair is a task.
  std::unordered_map<std::uint64_t, StoredScore> evaluator_scores;
  /// Digest of step n at index n - 1.
  std::vector<std::uint64_t> step_digests;
};

/// Those that hold what was made for the purpose; null for one that no design asks for.
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

/// Scores that are there before a design asks for them. One of the race is here or with the race,
/// never both: `take` hands it over, and `keep` takes it back when the race did not use it. One of
/// a test stays once it was asked for: who is tested again after an extension is not run again.
class KnownScores {
 public:
  explicit KnownScores(StoredDesign stored) : stored_(std::move(stored)) {}

  /// One of the store that was not asked for; null if there is none.
  const StoredScore* stored(const EvaluationKey& key) const;
  /// The score, if it is known.
  std::optional<StoredScore> take(const EvaluationKey& key);
  /// One of the race that no iteration uses, or one of a test.
  void keep(StoredScore score);
  /// Whether `take` would give one of the race.
  bool contains(const EvaluationKey& key) const;
  /// The stored ones of the race are no longer needed; their keys.
  std::set<EvaluationKey> discard_race();

  /// Scores of the store that were not asked for (yet), those computed ahead included.
  const StoredDesign& unasked() const { return stored_; }

 private:
  StoredDesign stored_;
  /// Of the race: computed ahead, or wanted by it and not used.
  std::unordered_map<std::uint64_t, StoredScore> unused_;
  std::unordered_map<std::uint64_t, StoredScore> tested_;
};

}  // namespace swarmsmith
