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
  TimePoint renewed;     ///< when the worker last said that it runs
  bool adopted = false;  ///< the worker had it already when it came back
  bool alone = false;    ///< the worker has nothing else
  bool began = false;    ///< and it said that it runs

  WorkerLoads::Place of_worker;  ///< kept by the table: its place among those of its worker
};

/// A task on its way to its first outcome, and what went wrong so far.
struct TaskRecord {
  Task task;
  std::optional<Lease> lease;
  /// A second copy, of a straggler; only beside `lease`, and on another worker. When the first
  /// lease ends without a result, this one takes its place.
  std::optional<Lease> second;
  std::int64_t attempts = 0;
  int deaths = 0;                      ///< worker processes that died while it ran alone
  std::vector<std::string> died_with;  ///< the principals of these
  int losses = 0;                      ///< workers that fell silent, or died, while it may have run
  int strays = 0;                      ///< the same of unknown workers
  int timeouts = 0;
  WorkerNumber avoid = 0;  ///< try elsewhere, if there is an elsewhere
  bool alone = false;      ///< it may have killed a worker: nothing else may run beside it
  /// The referee has the task, or an answer to it waits for the referee: no worker gets it.
  bool parked = false;
  /// Look-ahead that would end its campaign: not tried again before it is wanted.
  bool troubled = false;
  bool copied = false;  ///< since it was last queued

  /// The worker's lease, or null.
  Lease* lease_of(WorkerNumber worker);

  // Kept by the table.
  TimePoint added;  ///< when it became wanted, or look-ahead
  DesignQueues::Design* design = nullptr;
  std::list<PackedKey>::iterator place;  ///< in a queue, or in the order of age while leased
};

/// Tasks without an outcome by key: queued, or leased to one worker, or to two. A task enters by
/// `add` and leaves by `remove`; between the two it goes back and forth any number of times
/// (`grant`, `copy`, `requeue`), at least once to somebody. Queues: those that may only run alone;
/// those that a race waits for, by design; look-ahead, by design; look-ahead that waits until it is
/// wanted, since it may not run beside others or would end its campaign; and what is parked.
///
/// A record is in one place at any time: in one queue while it has no lease, in the order of age
/// while it has one. So every task that is in the table is offered again until it leaves, however
/// often workers are lost (orchestration facts, 5 "Leases"), and none is in two workers' hands but
/// by `copy`. A lease only says who was given the task: any result is welcome, since evaluations
/// are pure, so nothing has to be taken back from a worker before the task goes to another.
class LeaseTable {
 public:
  /// At the end of its queue. False when the key is there already. `now` is for the meters.
  bool add(Task task, TimePoint now = {});
  TaskRecord* find(PackedKey key);
  const TaskRecord* find(PackedKey key) const;
  /// `by` has its outcome; other workers that have a lease of it hold it a while yet.
  void remove(PackedKey key, WorkerNumber by = 0);
  void remove_all(std::uint32_t campaign);
  /// Look-ahead that is wanted now: to the end of the queue of those, if it is queued.
  void promote(TaskRecord& record, TimePoint now = {});
  /// Nothing more of the design is leased, or again; design 0 stands for the whole campaign.
  void hold(std::uint32_t campaign, std::int64_t design, bool held);
  bool is_held(std::uint32_t campaign, std::int64_t design) const;

  /// The next task that a race waits for, without taking it out; null when there is none. With
  /// `skip_avoided`, those that `worker` should not try are passed over. Free places and allowance
  /// are those of `DesignQueues::next`.
  TaskRecord* next(WorkerNumber worker, bool skip_avoided, std::size_t free = 0,
                   std::uint64_t allowance_us = 0);
  TaskRecord* next_ahead(WorkerNumber worker, bool skip_avoided);
  TaskRecord* next_alone();

  /// Leases a queued task, at a cost that its design is charged.
  void grant(TaskRecord& record, WorkerNumber worker, TimePoint now, std::uint64_t cost_us = 1);
  /// Leases it a second time.
  void copy(TaskRecord& record, WorkerNumber worker, TimePoint now);
  /// Takes the worker's lease away. When it was the only one, the task is queued, at the front or
  /// the end, and the answer is true.
  bool requeue(TaskRecord& record, WorkerNumber worker, bool at_front = true);
  /// Keeps a queued task from all workers, or lets it go to them again.
  void park(TaskRecord& record);
  void unpark(TaskRecord& record);
  /// Keeps queued look-ahead until a design wants it.
  void shelve(TaskRecord& record);

  /// Keys leased to a worker, the oldest lease first; second copies too.
  const std::list<PackedKey>& leases_of(WorkerNumber worker) const {
    return loads_.of(worker).leases;
  }
  /// Keys of leased tasks, by the age of their first leases, the oldest first.
  const std::list<PackedKey>& by_age() const { return by_age_; }

  std::size_t size() const { return records_.size(); }
  /// Tasks, with one lease or two.
  std::size_t leased() const { return by_age_.size(); }
  std::size_t copies() const { return copies_; }
  std::size_t queued() const { return records_.size() - leased(); }
  /// Queued tasks that a race waits for, and that are not held.
  std::size_t wanted_ready() const { return queues_.wanted(); }
  std::size_t wanted_leased() const { return wanted_leased_; }
  std::size_t ahead_ready() const { return queues_.ahead(); }
  /// Queued ones that a race waits for, held or not; design 0 stands for the whole campaign.
  std::size_t wanted_of(PoolDesign id) const;
  /// Queued ones that are not held.
  bool has_alone() const;
  std::size_t parked() const { return parked_.size(); }

  WorkerLoads& loads() { return loads_; }
  const WorkerLoads& loads() const { return loads_; }
  const DesignQueues& queues() const { return queues_; }

  /// Leases and waits are counted here, the rest by the scheduler. Grows with the campaigns.
  CampaignMeters& meters(std::uint32_t campaign);
  const std::vector<CampaignMeters>& meters() const { return meters_; }

 private:
  Lease leased_to(TaskRecord& record, WorkerNumber worker, TimePoint now);
  void end(TaskRecord& record, const Lease& lease);
  void enter_queue(TaskRecord& record, bool at_front);
  void leave_queue(TaskRecord& record);
  /// Of those that are in no design's queue.
  std::list<PackedKey>& special_queue(const TaskRecord& record);
  static bool is_special(const TaskRecord& record) {
    return record.alone || record.troubled || record.parked;
  }
  /// A task that must run alone, and may.
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
