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

/// The stored data of an evaluation with an outcome: enough to compare a second result bit by bit.
struct DoneEntry {
  PackedKey key = 0;
  std::uint64_t score_bits = 0;
  std::uint64_t state_digest = 0;  ///< 0 if rejected (see kRejectedBits)
};

/// The outcomes of active designs, by design: 24 bytes each in one array (open addressing, linear
/// probing, at most three quarters full), so that 100,000 outcomes take 6 MB. For designs that are
/// over, and for candidates that are out of their race, it remembers only that fact, so that memory
/// grows neither with the campaign nor with a design's evaluations.
class DoneTable {
 public:
  /// Inserts an outcome, or returns the existing entry; null if the design is over. An outcome of a
  /// candidate that is out of its race, such as a test, is kept until the next candidates are out.
  const DoneEntry* insert(PackedKey key, EvaluationStatus status, const Measured& measured);
  const DoneEntry* find(PackedKey key) const;
  /// Forgets the design's outcomes, because it needs no more of them.
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

  /// Null if the design never had an entry.
  const Outcomes* outcomes_of(PackedKey key) const;
  Outcomes& at(std::uint32_t campaign, DesignId design);

  std::vector<std::vector<Outcomes>> designs_;  ///< by campaign, then by design from 0
};

}  // namespace swarmsmith
