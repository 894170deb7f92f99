#include "coordinator/audit.h"

#include <algorithm>

#include "base/assert.h"
#include "base/hash.h"
#include "coordinator/done_table.h"
#include "coordinator/task_key.h"

namespace swarmsmith {
namespace {

/// Audits wait for a second worker; without one there is no need to remember them all.
constexpr std::size_t kMostWaiting = 1000;
constexpr int kMostLosses = 3;
/// A stream of its own beside those of seeds.
constexpr std::uint64_t kSalt = 0x61756469742e2e2eU;

bool agree(const Audits::Word& a, const Audits::Word& b) {
  return std::bit_cast<std::uint64_t>(a.score) == std::bit_cast<std::uint64_t>(b.score) &&
         a.state_digest == b.state_digest;
}

}  // namespace

bool Audits::chooses(PackedKey key, std::int64_t every) {
  return every > 0 && mix64(key ^ kSalt) % static_cast<std::uint64_t>(every) == 0;
}

void Audits::open(Task task, const Word& first) {
  const PackedKey key = key_of(task);
  const auto [at, fresh] = open_.try_emplace(key);
  SWARMSMITH_ASSERT(fresh, "an evaluation is audited once");
  at->second.task = std::move(task);
  at->second.words.push_back(first);
  queue_.push_back(key);
  if (queue_.size() > kMostWaiting) drop(queue_.front());
}

bool Audits::may_take(const Audit& audit, WorkerNumber worker) {
  return std::ranges::none_of(audit.words, [&](const Word& word) { return word.worker == worker; });
}

std::optional<Task> Audits::take_for(WorkerNumber worker) {
  const auto at =
      std::ranges::find_if(queue_, [&](PackedKey key) { return may_take(open_.at(key), worker); });
  if (at == queue_.end()) return std::nullopt;
  Audit& audit = open_.at(*at);
  queue_.erase(at);
  audit.out = true;
  return audit.task;
}

void Audits::give_back(PackedKey key) {
  const auto at = open_.find(key);
  if (at == open_.end() || !at->second.out) return;
  at->second.out = false;
  queue_.push_front(key);
  if (++at->second.losses >= kMostLosses) drop(key);
}

Audits::Verdict Audits::hear(PackedKey key, const Word& word) {
  const auto at = open_.find(key);
  SWARMSMITH_ASSERT(at != open_.end(), "an audit that is heard is open");
  Audit& audit = at->second;
  if (audit.out) {
    audit.out = false;
  } else {
    std::erase(queue_, key);
  }
  const std::vector<Word> before = audit.words;
  Verdict verdict{.differs = !agree(before.front(), word)};
  if (before.size() == 1 && verdict.differs) {
    audit.words.push_back(word);
    audit.losses = 0;
    queue_.push_front(key);
    return verdict;
  }
  open_.erase(at);
  if (before.size() == 1) return verdict;
  if (!verdict.differs) {
    verdict.outvoted = before[1].worker;
  } else if (agree(before[1], word)) {
    verdict.outvoted = before[0].worker;
  } else {
    verdict.no_two_agree = true;
  }
  return verdict;
}

bool Audits::can_go_on(const std::vector<WorkerNumber>& workers) const {
  return std::ranges::any_of(open_, [&](const auto& entry) {
    return entry.second.out || std::ranges::any_of(workers, [&](WorkerNumber worker) {
             return may_take(entry.second, worker);
           });
  });
}

void Audits::forget(std::uint32_t campaign) {
  std::erase_if(queue_, [&](PackedKey key) { return campaign_of(key) == campaign; });
  std::erase_if(open_, [&](const auto& entry) { return campaign_of(entry.first) == campaign; });
}

void Audits::drop(PackedKey key) {
  std::erase(queue_, key);
  open_.erase(key);
  ++given_up_;
}

}  // namespace swarmsmith
