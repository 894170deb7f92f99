#include "coordinator/pool/done_table.h"

#include <algorithm>

#include "base/assert.h"
#include "base/hash.h"

namespace swarmsmith {
namespace {

/// The bits of no finite score; they mark a rejected evaluation.
constexpr std::uint64_t kRejectedBits = 0x7ff8000000000001U;
constexpr std::size_t kFirstSize = 1024;

/// Counted from 1, like candidates.
DesignId design_of_key(PackedKey key) {
  return design_of(CandidateId{candidate_of(key)});
}

}  // namespace

DoneEntry DoneTable::entry_of(PackedKey key, EvaluationStatus status, const Measured& measured) {
  // All rejections are the same outcome, whatever a failed evaluation measured.
  if (status == EvaluationStatus::Rejected) return {key, kRejectedBits, 0};
  return {key, std::bit_cast<std::uint64_t>(measured.score), measured.state_digest};
}

std::size_t DoneTable::Outcomes::place_of(PackedKey key) const {
  SWARMSMITH_ASSERT(size < entries.size(), "the table always has a free place");
  // The size is a power of two. Keys are mixed, because those of one design follow each other.
  const std::size_t mask = entries.size() - 1;
  std::size_t at = static_cast<std::size_t>(mix64(key)) & mask;
  while (entries[at].key != 0 && entries[at].key != key)
    at = (at + 1) & mask;
  return at;
}

void DoneTable::Outcomes::grow() {
  std::vector<DoneEntry> old(entries.empty() ? kFirstSize : entries.size() * 2);
  old.swap(entries);
  for (const DoneEntry& entry : old) {
    if (entry.key != 0) entries[place_of(entry.key)] = entry;
  }
}

bool DoneTable::Outcomes::is_closed(PackedKey key) const {
  const CandidateId candidate{candidate_of(key)};
  return closed ||
         (candidate.value < passed_before && !std::ranges::binary_search(kept, candidate));
}

const DoneTable::Outcomes* DoneTable::outcomes_of(PackedKey key) const {
  const std::uint32_t campaign = campaign_of(key);
  if (campaign >= designs_.size()) return nullptr;
  const auto index = static_cast<std::size_t>(design_of_key(key).value - 1);
  return index < designs_[campaign].size() ? &designs_[campaign][index] : nullptr;
}

DoneTable::Outcomes& DoneTable::at(std::uint32_t campaign, DesignId design) {
  SWARMSMITH_ASSERT(design.value > 0, "designs count from 1");
  if (campaign >= designs_.size()) designs_.resize(campaign + 1);
  std::vector<Outcomes>& designs = designs_[campaign];
  const auto index = static_cast<std::size_t>(design.value - 1);
  if (index >= designs.size()) designs.resize(index + 1);
  return designs[index];
}

const DoneEntry* DoneTable::insert(PackedKey key, EvaluationStatus status,
                                   const Measured& measured) {
  SWARMSMITH_ASSERT(key != 0, "0 marks a free place");
  Outcomes& outcomes = at(campaign_of(key), design_of_key(key));
  // A late outcome of a design that is over is not needed for any comparison.
  if (outcomes.closed) return nullptr;
  if (4 * (outcomes.size + 1) > 3 * outcomes.entries.size()) outcomes.grow();
  DoneEntry& entry = outcomes.entries[outcomes.place_of(key)];
  if (entry.key == 0) {
    entry = entry_of(key, status, measured);
    ++outcomes.size;
  }
  return &entry;
}

const DoneEntry* DoneTable::find(PackedKey key) const {
  const Outcomes* outcomes = outcomes_of(key);
  if (outcomes == nullptr || outcomes->entries.empty()) return nullptr;
  const DoneEntry& entry = outcomes->entries[outcomes->place_of(key)];
  return entry.key == 0 ? nullptr : &entry;
}

void DoneTable::close(std::uint32_t campaign, DesignId design) {
  Outcomes& outcomes = at(campaign, design);
  outcomes = {};
  outcomes.closed = true;
}

void DoneTable::close_candidates(std::uint32_t campaign, const PassedCandidates& passed) {
  Outcomes& outcomes = at(campaign, passed.design);
  if (outcomes.closed) return;
  // Built anew: with linear probing, an entry that is erased would cut off those behind it.
  Outcomes left;
  left.passed_before = passed.before.value;
  left.kept = passed.kept;
  std::ranges::sort(left.kept);
  for (const DoneEntry& entry : outcomes.entries) {
    if (entry.key == 0 || left.is_closed(entry.key)) continue;
    if (4 * (left.size + 1) > 3 * left.entries.size()) left.grow();
    left.entries[left.place_of(entry.key)] = entry;
    ++left.size;
  }
  outcomes = std::move(left);
}

bool DoneTable::is_closed(PackedKey key) const {
  const Outcomes* outcomes = outcomes_of(key);
  return outcomes != nullptr && outcomes->is_closed(key);
}

std::size_t DoneTable::size() const {
  std::size_t size = 0;
  for (const std::vector<Outcomes>& designs : designs_) {
    for (const Outcomes& outcomes : designs)
      size += outcomes.size;
  }
  return size;
}

bool DoneTable::same(const DoneEntry& entry, EvaluationStatus status, const Measured& measured) {
  const DoneEntry other = entry_of(entry.key, status, measured);
  return entry.score_bits == other.score_bits && entry.state_digest == other.state_digest;
}

}  // namespace swarmsmith
