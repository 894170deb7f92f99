#include "coordinator/pool/lease_table.h"

#include <algorithm>
#include <functional>
#include <vector>

#include "base/assert.h"

namespace swarmsmith {

Lease* TaskRecord::lease_of(WorkerNumber worker) {
  if (lease && lease->worker == worker) return &*lease;
  if (second && second->worker == worker) return &*second;
  return nullptr;
}

bool LeaseTable::add(Task task, TimePoint now) {
  const PackedKey key = key_of(task);
  const auto [at, inserted] = records_.try_emplace(key);
  if (!inserted) return false;
  TaskRecord& record = at->second;
  record.task = std::move(task);
  record.added = now;
  record.design = &queues_.design(pool_design_of(key));
  enter_queue(record, false);
  return true;
}

TaskRecord* LeaseTable::find(PackedKey key) {
  const auto at = records_.find(key);
  return at == records_.end() ? nullptr : &at->second;
}

const TaskRecord* LeaseTable::find(PackedKey key) const {
  const auto at = records_.find(key);
  return at == records_.end() ? nullptr : &at->second;
}

std::list<PackedKey>& LeaseTable::special_queue(const TaskRecord& record) {
  if (record.parked) return parked_;
  return record.task.ahead ? unwanted_ : alone_;
}

void LeaseTable::enter_queue(TaskRecord& record, bool at_front) {
  SWARMSMITH_ASSERT(!record.lease, "a task in a queue has no lease");
  const PackedKey key = key_of(record.task);
  const bool ahead = record.task.ahead;
  if (!is_special(record)) {
    record.place = at_front ? queues_.push_front(*record.design, ahead, key)
                            : queues_.push_back(*record.design, ahead, key);
    return;
  }
  std::list<PackedKey>& queue = special_queue(record);
  record.place = queue.insert(at_front ? queue.begin() : queue.end(), key);
}

void LeaseTable::leave_queue(TaskRecord& record) {
  // The place is one of the queue that follows from the record's flags, so while a task is queued,
  // they change only between `leave_queue` and `enter_queue`.
  SWARMSMITH_ASSERT(!record.lease, "a task in a queue has no lease");
  if (!is_special(record)) {
    queues_.erase(*record.design, record.task.ahead, record.place);
  } else {
    special_queue(record).erase(record.place);
  }
}

void LeaseTable::remove(PackedKey key, WorkerNumber by) {
  const auto at = records_.find(key);
  SWARMSMITH_ASSERT(at != records_.end(), "a task that is removed is in the table");
  TaskRecord& record = at->second;
  if (!record.lease) {
    SWARMSMITH_ASSERT(!record.second, "a second copy needs a first lease");
    leave_queue(record);
  } else {
    for (const std::optional<Lease>* lease : {&record.second, &record.lease}) {
      if (!*lease) continue;
      end(record, **lease);
      // The other worker is still running it: its slot is busy until the worker reports.
      if ((*lease)->worker != by) loads_.linger((*lease)->worker, key, (*lease)->renewed);
    }
    if (record.second) --copies_;
    by_age_.erase(record.place);
    queues_.on_unleased(*record.design, record.task.ahead);
    if (!record.task.ahead) --wanted_leased_;
    SWARMSMITH_ASSERT(wanted_leased_ <= leased(), "no more wanted leases than leases");
  }
  records_.erase(at);
}

void LeaseTable::remove_all(std::uint32_t campaign) {
  std::vector<PackedKey> keys;
  for (const auto& [key, record] : records_) {
    if (record.task.campaign == campaign) keys.push_back(key);
  }
  for (const PackedKey key : keys)
    remove(key);
  queues_.forget(campaign);
}

void LeaseTable::promote(TaskRecord& record, TimePoint now) {
  SWARMSMITH_ASSERT(record.task.ahead, "only look-ahead is promoted");
  // The race waits for it only from now on.
  record.added = now;
  if (!record.lease) {
    leave_queue(record);
    record.task.ahead = false;
    record.troubled = false;
    enter_queue(record, false);
    return;
  }
  record.task.ahead = false;
  record.troubled = false;
  queues_.on_promoted(*record.design);
  loads_.promote(record.lease->worker);
  ++wanted_leased_;
}

void LeaseTable::hold(std::uint32_t campaign, std::int64_t design, bool held) {
  queues_.hold({campaign, design}, held);
}

bool LeaseTable::is_held(std::uint32_t campaign, std::int64_t design) const {
  return queues_.is_held({campaign, design});
}

TaskRecord* LeaseTable::next(WorkerNumber worker, bool skip_avoided, std::size_t free,
                             std::uint64_t allowance_us) {
  // The first choice is a task that did not fail or take too long on this worker.
  const auto fits = [&](PackedKey key) { return !skip_avoided || find(key)->avoid != worker; };
  return found(queues_.next(free, allowance_us, std::cref(fits)));
}

TaskRecord* LeaseTable::next_ahead(WorkerNumber worker, bool skip_avoided) {
  const auto fits = [&](PackedKey key) { return !skip_avoided || find(key)->avoid != worker; };
  return found(queues_.next_ahead(std::cref(fits)));
}

TaskRecord* LeaseTable::next_alone() {
  const auto at = std::ranges::find_if(alone_, [&](PackedKey key) { return is_ready(key); });
  return at == alone_.end() ? nullptr : find(*at);
}

std::size_t LeaseTable::wanted_of(PoolDesign id) const {
  // These are in a queue of their own, but a race waits for them, too.
  const auto alone = std::ranges::count_if(alone_, [&](PackedKey key) {
    const PoolDesign of = pool_design_of(key);
    return of.campaign == id.campaign && (id.design == 0 || of.design == id.design);
  });
  return queues_.wanted_of(id) + static_cast<std::size_t>(alone);
}

bool LeaseTable::has_alone() const {
  return std::ranges::any_of(alone_, [&](PackedKey key) { return is_ready(key); });
}

Lease LeaseTable::leased_to(TaskRecord& record, WorkerNumber worker, TimePoint now) {
  ++meters(record.task.campaign).leased;
  return {.worker = worker,
          .attempt = ++record.attempts,
          .granted = now,
          .renewed = now,
          .adopted = false,
          .alone = record.alone,
          .of_worker = loads_.lease(worker, key_of(record.task), record.task.ahead)};
}

void LeaseTable::grant(TaskRecord& record, WorkerNumber worker, TimePoint now,
                       std::uint64_t cost_us) {
  SWARMSMITH_ASSERT(!record.lease && !record.parked,
                    "a granted task has no lease, and the referee does not have it");
  queues_.on_leased(*record.design, record.task.ahead, cost_us);
  leave_queue(record);
  // Only the first wait: later ones include the time of lost attempts.
  if (record.attempts == 0 && !record.task.ahead) {
    meters(record.task.campaign).queue_wait.observe(now - record.added);
  }
  record.lease = leased_to(record, worker, now);
  record.place = by_age_.insert(by_age_.end(), key_of(record.task));
  if (!record.task.ahead) ++wanted_leased_;
}

CampaignMeters& LeaseTable::meters(std::uint32_t campaign) {
  if (campaign >= meters_.size()) meters_.resize(campaign + 1);
  return meters_[campaign];
}

void LeaseTable::copy(TaskRecord& record, WorkerNumber worker, TimePoint now) {
  SWARMSMITH_ASSERT(record.lease && !record.second && record.lease->worker != worker,
                    "a second copy goes to another worker than the only lease");
  record.second = leased_to(record, worker, now);
  record.copied = true;
  ++copies_;
}

bool LeaseTable::requeue(TaskRecord& record, WorkerNumber worker, bool at_front) {
  const Lease* lease = record.lease_of(worker);
  SWARMSMITH_ASSERT(lease != nullptr, "a lease that ends is the worker's");
  end(record, *lease);
  if (record.second) {
    if (lease == &*record.lease) {
      // It becomes the youngest, because the copy's time began only when it was made.
      record.lease = record.second;
      by_age_.splice(by_age_.end(), by_age_, record.place);
    }
    record.second.reset();
    --copies_;
    return false;
  }
  record.lease.reset();
  record.copied = false;
  by_age_.erase(record.place);
  queues_.on_unleased(*record.design, record.task.ahead);
  if (!record.task.ahead) --wanted_leased_;
  SWARMSMITH_ASSERT(wanted_leased_ <= leased(), "no more wanted leases than leases");
  // Normally at the front: its race asked for it before all other tasks that it waits for.
  enter_queue(record, at_front);
  return true;
}

void LeaseTable::park(TaskRecord& record) {
  SWARMSMITH_ASSERT(!record.lease, "a parked task has no lease");
  if (record.parked) return;
  leave_queue(record);
  record.parked = true;
  enter_queue(record, false);
}

void LeaseTable::unpark(TaskRecord& record) {
  if (!record.parked) return;
  leave_queue(record);
  record.parked = false;
  enter_queue(record, true);
}

void LeaseTable::shelve(TaskRecord& record) {
  SWARMSMITH_ASSERT(!record.lease && record.task.ahead, "look-ahead is shelved, without a lease");
  leave_queue(record);
  record.parked = false;
  record.troubled = true;
  enter_queue(record, true);
}

void LeaseTable::end(TaskRecord& record, const Lease& lease) {
  loads_.end(lease.worker, lease.of_worker, record.task.ahead);
}

}  // namespace swarmsmith
