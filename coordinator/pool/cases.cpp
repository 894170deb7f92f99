#include "coordinator/pool/cases.h"

#include <algorithm>
#include <utility>

#include "base/assert.h"
#include "coordinator/pool/task_key.h"

namespace swarmsmith {

void Cases::open(Task task, std::optional<Said> said, bool audit) {
  const PackedKey key = key_of(task);
  const auto [at, fresh] = open_.try_emplace(key);
  Case& it = at->second;
  if (said) it.said.push_back(std::move(*said));
  // From here the case is new, or it was an audit and a design now waits for it. A case that a
  // design waits for never becomes an audit.
  if (!fresh && (audit || !it.audit)) return;
  it.audit = audit;
  // The referee is evaluating it already.
  if (out_ == key) return;
  if (fresh) {
    it.task = std::move(task);
  } else {
    std::erase(audits_, key);
  }
  (audit ? audits_ : urgent_).push_back(key);
}

std::optional<Task> Cases::next() {
  // One case at a time. Audits wait: no design needs them to continue.
  std::deque<PackedKey>& queue = urgent_.empty() ? audits_ : urgent_;
  if (out_ || queue.empty()) return std::nullopt;
  SWARMSMITH_ASSERT(open_.contains(queue.front()),
                    "every task that waits for the referee has a case");
  out_ = queue.front();
  queue.pop_front();
  return open_.at(*out_).task;
}

std::optional<Case> Cases::close(PackedKey key) {
  if (out_ == key) out_.reset();
  auto found = open_.extract(key);
  // Its campaign was stopped while the referee evaluated it.
  if (!found) return std::nullopt;
  std::erase(urgent_, key);
  std::erase(audits_, key);
  return std::move(found.mapped());
}

const Case* Cases::find(PackedKey key) const {
  const auto at = open_.find(key);
  return at == open_.end() ? nullptr : &at->second;
}

std::size_t Cases::without_worker() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(open_, [](const auto& each) { return each.second.said.empty(); }));
}

std::vector<Case> Cases::forget(std::uint32_t campaign) {
  std::vector<Case> gone;
  const auto is_of = [&](PackedKey key) { return campaign_of(key) == campaign; };
  std::erase_if(urgent_, is_of);
  std::erase_if(audits_, is_of);
  std::erase_if(open_, [&](auto& each) {
    if (!is_of(each.first)) return false;
    gone.push_back(std::move(each.second));
    return true;
  });
  return gone;
}

}  // namespace swarmsmith
