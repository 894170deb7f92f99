#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "proto/key.h"
#include "storage/rows.h"

namespace swarmsmith {

/// What is known of an evaluation that has an outcome: enough to compare a second one bit by bit.
struct DoneEntry {
  PackedKey key = 0;
  std::uint64_t score_bits = 0;
  std::uint64_t state_digest = 0;  ///< of a rejected evaluation: kRejected
};

/// Every outcome of a campaign, 24 bytes each in one array (open addressing, linear probing, at
/// most three quarters full): three million of them are 100 MB.
class DoneTable {
 public:
  /// Inserts, or returns the entry that is there already.
  const DoneEntry* insert(PackedKey key, EvaluationStatus status, double score,
                          std::uint64_t state_digest);
  const DoneEntry* find(PackedKey key) const;
  std::size_t size() const { return size_; }

  static bool same(const DoneEntry& entry, EvaluationStatus status, double score,
                   std::uint64_t state_digest);

 private:
  std::size_t place_of(PackedKey key) const;
  void grow();

  std::vector<DoneEntry> entries_;
  std::size_t size_ = 0;
};

}  // namespace swarmsmith
