#pragma once

#include "base/clock.h"
#include "coordinator/pool/task_book.h"
#include "coordinator/pool/trust.h"
#include "coordinator/pool/worker_registry.h"

namespace swarmsmith {

/// How a worker was lost.
enum class Loss {
  Death,    ///< its connection was closed, so the process has ended
  Silence,  ///< no message for too long, usually because of the network
  Left,     ///< it said goodbye or was sent away
};

/// Handles the loss of a worker: its tasks go to other workers, and tasks that may have killed it
/// are identified (orchestration facts, 5 "Poison tasks"). Only tasks that were running can be the
/// cause, never those queued behind them, and a stranger's worker never counts against a task.
///
/// Workers start tasks in the order of their leases and report at most 64 results at a time, so the
/// tasks that were running are among the first (slots + 64) leases. After the death of a worker of
/// a proven principal, each of these tasks is tried again *alone*, on a worker that has no other
/// task and reports when it begins; only a death there counts. With programs instead of the
/// simulator, a task runs alone after its second loss, and three deaths while it runs alone make it
/// a rejection.
class LostWorkers {
 public:
  /// All three must outlive this object and keep their addresses.
  LostWorkers(TaskBook& book, WorkerRegistry& workers, Trust& trust)
      : book_(&book), workers_(&workers), trust_(&trust) {}

  /// The worker is disconnected; its row gets `state`. All of its leases end.
  void lose(WorkerEntry& entry, Loss loss, WorkerState state, TimePoint now);
  /// The worker is back: the tasks that were blamed for its disappearance did not kill it.
  void take_back_charges(WorkerEntry& entry);

 private:
  /// The conclusion about a task that was leased only to the lost worker and may have been running.
  enum class Blame { None, Task, Rejected };
  Blame blame(WorkerEntry& entry, TaskRecord& record, Loss loss);
  Blame blame_of_program(WorkerEntry& entry, TaskRecord& record, Loss loss);

  TaskBook* book_;
  WorkerRegistry* workers_;
  Trust* trust_;
};

}  // namespace swarmsmith
