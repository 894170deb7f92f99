#include "coordinator/lease_table.h"

#include "base/assert.h"

namespace swarmsmith {
namespace {

const std::list<PackedKey> kNoLeases;

}  // namespace

LeaseTable::Queue& LeaseTable::queue_of(const TaskRecord& record) {
  if (record.alone) return alone_;
  return record.task.ahead ? ahead_ : wanted_;
}

bool LeaseTable::add(Task task, TimePoint now) {
  const PackedKey key = key_of(task);
  const auto [at, inserted] = records_.try_emplace(key);
  if (!inserted) return false;
  TaskRecord& record = at->second;
  record.task = std::move(task);
  record.added = now;
  record.queued = ++places_;
  queue_of(record).push_back({key, record.queued});
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

void LeaseTable::remove(PackedKey key) {
  const auto at = records_.find(key);
  SWARMSMITH_ASSERT(at != records_.end(), "a task that is removed is in the table");
  if (at->second.lease) {
    drop_lease(at->second);
  } else {
    leave_queue(at->second);
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
}

void LeaseTable::promote(TaskRecord& record) {
  record.task.ahead = false;
  if (record.lease || record.alone) return;
  record.queued = ++places_;
  wanted_.push_back({key_of(record.task), record.queued});
}

TaskRecord* LeaseTable::front_of(Queue& queue) {
  while (!queue.empty()) {
    TaskRecord* record = find(queue.front().key);
    if (record != nullptr && record->queued == queue.front().queued) return record;
    queue.pop_front();
  }
  return nullptr;
}

TaskRecord* LeaseTable::next(WorkerNumber worker, bool skip_avoided) {
  for (Queue* queue : {&wanted_, &ahead_}) {
    TaskRecord* front = front_of(*queue);
    if (front == nullptr) continue;
    if (!skip_avoided || front->avoid != worker) return front;
    for (const Place& place : *queue) {
      TaskRecord* record = find(place.key);
      if (record != nullptr && record->queued == place.queued && record->avoid != worker) {
        return record;
      }
    }
  }
  return nullptr;
}

TaskRecord* LeaseTable::next_alone() {
  return front_of(alone_);
}

void LeaseTable::grant(TaskRecord& record, WorkerNumber worker, TimePoint now) {
  SWARMSMITH_ASSERT(!record.lease, "a task that is granted has no lease");
  leave_queue(record);
  record.lease = Lease{.worker = worker,
                       .attempt = ++record.attempts,
                       .granted = now,
                       .renewed = now,
                       .adopted = false,
                       .alone = record.alone};
  std::list<PackedKey>& leases = by_worker_[worker];
  record.of_worker = leases.insert(leases.end(), key_of(record.task));
  ++leased_;
  CampaignMeters& meters = this->meters(record.task.campaign);
  ++meters.leased;
  if (record.attempts == 1) meters.queue_wait.observe(now - record.added);
}

CampaignMeters& LeaseTable::meters(std::uint32_t campaign) {
  if (campaign >= meters_.size()) meters_.resize(campaign + 1);
  return meters_[campaign];
}

void LeaseTable::requeue(TaskRecord& record) {
  SWARMSMITH_ASSERT(record.lease, "a task that is requeued has a lease");
  drop_lease(record);
  record.queued = ++places_;
  queue_of(record).push_front({key_of(record.task), record.queued});
  if (record.alone) ++alone_count_;
}

void LeaseTable::drop_lease(TaskRecord& record) {
  const auto leases = by_worker_.find(record.lease->worker);
  leases->second.erase(record.of_worker);
  if (leases->second.empty()) by_worker_.erase(leases);
  record.lease.reset();
  --leased_;
}

/// The place in the queue stays behind, stale; it is dropped when it comes to the front.
void LeaseTable::leave_queue(TaskRecord& record) {
  record.queued = 0;
  if (record.alone) --alone_count_;
}

const std::list<PackedKey>& LeaseTable::leases_of(WorkerNumber worker) const {
  const auto at = by_worker_.find(worker);
  return at == by_worker_.end() ? kNoLeases : at->second;
}

}  // namespace swarmsmith
