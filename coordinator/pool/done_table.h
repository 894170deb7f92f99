#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "coordinator/design/work_source.h"
#include "coordinator/pool/task_key.h"
#include "proto/key.h"
#include "storage/rows.h"

namespace swarmsmith {

/// What is known of an evaluation that has an outcome: enough to compare a second one bit by bit.
struct DoneEntry {
  PackedKey key = 0;
  std::uint64_t score_bits = 0;
  std::uint64_t state_digest = 0;  ///< of a rejected evaluation: kRejected
};

/// The outcomes of the designs that go on, by design: 24 bytes each in one array (open addressing,
/// linear probing, at most three quarters full), so that 100,000 take 6 MB. Of a design that is
/// over, and of candidates that are out of their race, only that is remembered: memory grows
/// neither with the campaign nor with a design's evaluations.
class DoneTable {
 public:
  /// Inserts, or returns the entry that is there already; null when the design is over. What comes
  /// of a candidate that is out of its race, such as a test, is known until others are out.
  const DoneEntry* insert(PackedKey key, EvaluationStatus status, const Measured& measured);
  const DoneEntry* find(PackedKey key) const;
  /// Forgets the design's outcomes: it needs no more of them, whatever comes.
  void close(std::uint32_t campaign, DesignId design);
  /// The same for the design's candidates that are out of its race.
  void close_candidates(std::uint32_t campaign, const PassedCandidates& passed);
  bool is_closed(PackedKey key) const;
  std::size_t size() const;

  static DoneEntry entry_of(PackedKey key, EvaluationStatus status, const Measured& measured);
  static bool same(const DoneEntry& entry, EvaluationStatus status, const Measured& measured);

 private:
  struct Outcomes {
    std::vector<DoneEntry> entries;
    std::size_t size = 0;
    bool closed = false;
    std::int64_t passed_before = 0;  ///< candidates before this one that are not `kept` are out
    std::vector<CandidateId> kept;   ///< ascending

    bool is_closed(PackedKey key) const;
    std::size_t place_of(PackedKey key) const;
    void grow();
  };

  /// Null when nothing was ever known of it.
  const Outcomes* outcomes_of(PackedKey key) const;
  Outcomes& at(std::uint32_t campaign, DesignId design);

  std::vector<std::vector<Outcomes>> designs_;  ///< by campaign, by design from 0
};

}  // namespace swarmsmith
