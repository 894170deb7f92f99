#pragma once

#include <cstddef>
#include <deque>
#include <list>
#include <optional>
#include <unordered_map>
#include <vector>

#include "base/clock.h"
#include "coordinator/campaign_meters.h"
#include "coordinator/task.h"
#include "coordinator/task_key.h"

namespace swarmsmith {

/// WorkerRow::id.
using WorkerNumber = std::int64_t;

/// A worker's right to an evaluation.
struct Lease {
  WorkerNumber worker = 0;
  std::int64_t attempt = 0;
  TimePoint granted;
  TimePoint renewed;     ///< when the worker last said that it runs
  bool adopted = false;  ///< the worker had it already when it came back
  bool alone = false;    ///< the worker has nothing else
};

/// A task on its way to its first outcome, and what went wrong so far.
struct TaskRecord {
  Task task;
  std::optional<Lease> lease;
  std::int64_t attempts = 0;
  int failures = 0;  ///< workers said that there is no score
  int deaths = 0;    ///< worker processes that died while it ran alone
  int losses = 0;    ///< workers that fell silent while it may have run
  int timeouts = 0;
  WorkerNumber avoid = 0;  ///< try elsewhere, if there is an elsewhere
  bool alone = false;      ///< it may have killed a worker: nothing else may run beside it
  bool audit = false;      ///< it has its result, and this is the second one (audit.h)

  // Kept by the table.
  TimePoint added;
  std::uint64_t queued = 0;                  ///< names its place in a queue; stale ones differ
  std::list<PackedKey>::iterator of_worker;  ///< its place among the leases of its worker
};

/// Tasks without an outcome: queued, or leased to one worker each, by key. A task enters by `add`
/// and leaves by `remove`; between the two it goes back and forth any number of times (`grant`,
/// `requeue`), at least once to somebody. Queues: those that may only run alone; those that a race
/// waits for; look-ahead.
class LeaseTable {
 public:
  /// At the end of its queue. False when the key is there already. `now` is for the meters.
  bool add(Task task, TimePoint now = {});
  TaskRecord* find(PackedKey key);
  const TaskRecord* find(PackedKey key) const;
  void remove(PackedKey key);
  void remove_all(std::uint32_t campaign);
  /// Look-ahead that is wanted now: to the queue of those, if it is queued.
  void promote(TaskRecord& record);

  /// The next task for a worker that has others, without taking it out; null when there is none.
  /// With `skip_avoided`, tasks that should be tried elsewhere are passed over.
  TaskRecord* next(WorkerNumber worker, bool skip_avoided);
  TaskRecord* next_alone();

  /// Leases a queued task.
  void grant(TaskRecord& record, WorkerNumber worker, TimePoint now);
  /// Takes the lease away and queues the task at the front.
  void requeue(TaskRecord& record);

  /// Keys leased to a worker, the oldest lease first.
  const std::list<PackedKey>& leases_of(WorkerNumber worker) const;

  std::size_t size() const { return records_.size(); }
  std::size_t leased() const { return leased_; }
  std::size_t queued() const { return records_.size() - leased_; }
  bool has_alone() const { return alone_count_ > 0; }

  /// Leases and waits are counted here, the rest by the scheduler. Grows with the campaigns.
  CampaignMeters& meters(std::uint32_t campaign);
  const std::vector<CampaignMeters>& meters() const { return meters_; }

 private:
  struct Place {
    PackedKey key = 0;
    std::uint64_t queued = 0;
  };
  using Queue = std::deque<Place>;

  Queue& queue_of(const TaskRecord& record);
  TaskRecord* front_of(Queue& queue);
  void drop_lease(TaskRecord& record);
  void leave_queue(TaskRecord& record);

  std::unordered_map<PackedKey, TaskRecord> records_;
  std::unordered_map<WorkerNumber, std::list<PackedKey>> by_worker_;
  Queue alone_, wanted_, ahead_;
  std::vector<CampaignMeters> meters_;
  std::uint64_t places_ = 0;
  std::size_t leased_ = 0;
  std::size_t alone_count_ = 0;  ///< queued ones
};

}  // namespace swarmsmith
