#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <optional>
#include <unordered_map>
#include <vector>

#include "base/clock.h"
#include "coordinator/design/task.h"
#include "coordinator/pool/campaign_meters.h"
#include "coordinator/pool/design_queues.h"
#include "coordinator/pool/task_key.h"
#include "coordinator/pool/worker_loads.h"

namespace swarmsmith {

/// A worker's right to an evaluation.
struct Lease {
  WorkerNumber worker = 0;
  std::int64_t attempt = 0;
  TimePoint granted;
  TimePoint renewed;     ///< when the worker last reported that it runs
  bool adopted = false;  ///< the worker had the task already when it reconnected
  bool alone = false;    ///< the worker has no other task
  bool began = false;    ///< the worker has reported that it runs

  WorkerLoads::Place of_worker;  ///< maintained by the table: its place in its worker's list
};

/// A task that has no outcome yet, and its failed attempts so far.
struct TaskRecord {
  Task task;
  std::optional<Lease> lease;
  /// A second copy, because the first worker is slow; exists only beside `lease`, and on another
  /// worker. If the first lease ends without a result, this lease replaces it.
  std::optional<Lease> second;
  std::int64_t attempts = 0;
  int deaths = 0;                      ///< worker processes that died while it ran alone
  std::vector<std::string> died_with;  ///< the principals of these workers
  int losses = 0;                      ///< workers lost while it may have been running
  int strays = 0;                      ///< the same for strangers' workers
  int timeouts = 0;
  WorkerNumber avoid = 0;  ///< try another worker, if there is one
  bool alone = false;      ///< it may have killed a worker, so no other task may run beside it
  /// The referee has the task, or a result of it waits for the referee: it is not leased.
  bool parked = false;
  /// A look-ahead task whose failure would stop its campaign: not tried again before it is wanted.
  bool troubled = false;
  bool copied = false;  ///< copied since it was last queued

  /// The worker's lease, or null.
  Lease* lease_of(WorkerNumber worker);

  // Maintained by the table.
  TimePoint added;  ///< when it became wanted or was added as look-ahead
  DesignQueues::Design* design = nullptr;
  std::list<PackedKey>::iterator place;  ///< in a queue, or in `by_age` while leased
};

/// All tasks without an outcome, by key. A task is queued, or leased to one worker or two. It
/// enters by `add`, leaves by `remove`, and in between may change state any number of times
/// (`grant`, `copy`, `requeue`). There are queues for tasks that may only run alone; for tasks that
/// a race waits for, by design; for look-ahead, by design; for look-ahead that waits until it is
/// wanted, because it must not run beside other tasks or its failure would stop its campaign; and
/// for parked tasks.
///
/// At any time, a record is in exactly one place: in one queue while it has no lease, and in the
/// order of age while it has one. So every task in the table is offered again until it leaves,
/// however often workers are lost (orchestration facts, 5 "Leases"), and two workers have the same
/// task only after `copy`. A lease only records which worker was given the task. Any result is
/// accepted, because evaluations are pure, so a task need not be taken back from a worker before it
/// is leased to another one.
class LeaseTable {
 public:
  /// Adds a task at the end of its queue. False if the key exists already. `now` is for the meters.
  bool add(Task task, TimePoint now = {});
  TaskRecord* find(PackedKey key);
  const TaskRecord* find(PackedKey key) const;
  /// `by` has delivered the outcome; another worker with a lease of it has it for a while longer.
  void remove(PackedKey key, WorkerNumber by = 0);
  void remove_all(std::uint32_t campaign);
  /// A look-ahead task is wanted now: if queued, it moves to the end of the wanted tasks.
  void promote(TaskRecord& record, TimePoint now = {});
  /// Stops or resumes leasing of the design's tasks; design 0 means the whole campaign.
  void hold(std::uint32_t campaign, std::int64_t design, bool held);
  bool is_held(std::uint32_t campaign, std::int64_t design) const;

  /// The next task that a race waits for, still in its queue; null if there is none. With
  /// `skip_avoided`, skips tasks that `worker` should not try. `free` and `allowance_us` are as in
  /// `DesignQueues::next`.
  TaskRecord* next(WorkerNumber worker, bool skip_avoided, std::size_t free = 0,
                   std::uint64_t allowance_us = 0);
  TaskRecord* next_ahead(WorkerNumber worker, bool skip_avoided);
  TaskRecord* next_alone();

  /// Leases a queued task; its design is charged this cost.
  void grant(TaskRecord& record, WorkerNumber worker, TimePoint now, std::uint64_t cost_us = 1);
  /// Leases the task to a second worker.
  void copy(TaskRecord& record, WorkerNumber worker, TimePoint now);
  /// Ends the worker's lease. If it was the only one, queues the task and returns true.
  bool requeue(TaskRecord& record, WorkerNumber worker, bool at_front = true);
  /// Keeps a queued task from all workers, or releases it again.
  void park(TaskRecord& record);
  void unpark(TaskRecord& record);
  /// Keeps a queued look-ahead task back until a design wants it.
  void shelve(TaskRecord& record);

  /// The keys leased to a worker, the oldest lease first, including second copies.
  const std::list<PackedKey>& leases_of(WorkerNumber worker) const {
    return loads_.of(worker).leases;
  }
  /// The keys of leased tasks, by the age of their first lease, the oldest first.
  const std::list<PackedKey>& by_age() const { return by_age_; }

  std::size_t size() const { return records_.size(); }
  /// The number of tasks with one or two leases.
  std::size_t leased() const { return by_age_.size(); }
  std::size_t copies() const { return copies_; }
  std::size_t queued() const { return records_.size() - leased(); }
  /// The number of queued tasks that a race waits for and that are not held.
  std::size_t wanted_ready() const { return queues_.wanted(); }
  std::size_t wanted_leased() const { return wanted_leased_; }
  std::size_t ahead_ready() const { return queues_.ahead(); }
  /// Queued tasks that a race waits for, held or not; design 0 means the whole campaign.
  std::size_t wanted_of(PoolDesign id) const;
  /// Whether there is a queued task that must run alone and is not held.
  bool has_alone() const;
  std::size_t parked() const { return parked_.size(); }

  WorkerLoads& loads() { return loads_; }
  const WorkerLoads& loads() const { return loads_; }
  const DesignQueues& queues() const { return queues_; }

  /// Leases and waiting times are counted here, and the rest by the scheduler.
  CampaignMeters& meters(std::uint32_t campaign);
  const std::vector<CampaignMeters>& meters() const { return meters_; }

 private:
  Lease leased_to(TaskRecord& record, WorkerNumber worker, TimePoint now);
  void end(TaskRecord& record, const Lease& lease);
  void enter_queue(TaskRecord& record, bool at_front);
  void leave_queue(TaskRecord& record);
  /// The queue for a task that is not in a design's queue.
  std::list<PackedKey>& special_queue(const TaskRecord& record);
  static bool is_special(const TaskRecord& record) {
    return record.alone || record.troubled || record.parked;
  }
  /// Whether a task that must run alone may be leased now.
  bool is_ready(PackedKey key) const { return !find(key)->design->held; }
  TaskRecord* found(std::optional<PackedKey> key) { return key ? find(*key) : nullptr; }

  std::unordered_map<PackedKey, TaskRecord> records_;
  DesignQueues queues_;
  std::list<PackedKey> alone_, unwanted_, parked_;
  std::list<PackedKey> by_age_;
  WorkerLoads loads_;
  std::vector<CampaignMeters> meters_;
  std::size_t wanted_leased_ = 0;
  std::size_t copies_ = 0;
};

}  // namespace swarmsmith
