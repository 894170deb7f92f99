#include "coordinator/done_table.h"

#include "base/hash.h"

namespace swarmsmith {
namespace {

/// Bits of no finite score: marks a rejected evaluation.
constexpr std::uint64_t kRejectedBits = 0x7ff8000000000001U;
constexpr std::size_t kFirstSize = 1024;

DoneEntry entry_of(PackedKey key, EvaluationStatus status, double score,
                   std::uint64_t state_digest) {
  if (status == EvaluationStatus::Rejected) return {key, kRejectedBits, 0};
  return {key, std::bit_cast<std::uint64_t>(score), state_digest};
}

}  // namespace

std::size_t DoneTable::place_of(PackedKey key) const {
  const std::size_t mask = entries_.size() - 1;
  std::size_t at = static_cast<std::size_t>(mix64(key)) & mask;
  while (entries_[at].key != 0 && entries_[at].key != key)
    at = (at + 1) & mask;
  return at;
}

void DoneTable::grow() {
  std::vector<DoneEntry> old(entries_.empty() ? kFirstSize : entries_.size() * 2);
  old.swap(entries_);
  for (const DoneEntry& entry : old) {
    if (entry.key != 0) entries_[place_of(entry.key)] = entry;
  }
}

const DoneEntry* DoneTable::insert(PackedKey key, EvaluationStatus status, double score,
                                   std::uint64_t state_digest) {
  if (4 * (size_ + 1) > 3 * entries_.size()) grow();
  DoneEntry& entry = entries_[place_of(key)];
  if (entry.key == 0) {
    entry = entry_of(key, status, score, state_digest);
    ++size_;
  }
  return &entry;
}

const DoneEntry* DoneTable::find(PackedKey key) const {
  if (entries_.empty()) return nullptr;
  const DoneEntry& entry = entries_[place_of(key)];
  return entry.key == 0 ? nullptr : &entry;
}

bool DoneTable::same(const DoneEntry& entry, EvaluationStatus status, double score,
                     std::uint64_t state_digest) {
  const DoneEntry other = entry_of(entry.key, status, score, state_digest);
  return entry.score_bits == other.score_bits && entry.state_digest == other.state_digest;
}

}  // namespace swarmsmith
