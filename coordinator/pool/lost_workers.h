#pragma once

#include "base/clock.h"
#include "coordinator/pool/task_book.h"
#include "coordinator/pool/trust.h"
#include "coordinator/pool/worker_registry.h"

namespace swarmsmith {

/// How a worker was lost.
enum class Loss {
  Death,    ///< its connection was closed: the process ended
  Silence,  ///< nothing was heard for too long: mostly the network's doing
  Left,     ///< it said so, or was sent away
};

/// What follows when a worker is lost: its tasks go to others, and those that may have killed it
/// are found (orchestration facts, 5 "Poison tasks"). Only what ran can be to blame, never what was
/// queued behind it, and no task is blamed for what a stranger's worker did.
///
/// Workers start tasks in the order of their leases and report 64 results at most at a time, so
/// what ran is among the first (slots + 64) leases. After a death of a worker that has proved
/// itself each of these is tried again *alone*, on a worker that has nothing else and says when it
/// begins, and only a death there counts. With programs in place of the simulator three such are a
/// rejection, and the second death is the first that makes a task run alone.
class LostWorkers {
 public:
  /// All must stay where they are.
  LostWorkers(TaskBook& book, WorkerRegistry& workers, Trust& trust)
      : book_(&book), workers_(&workers), trust_(&trust) {}

  /// The worker is not connected any more; its row says `state`. None of its leases remains.
  void lose(WorkerEntry& entry, Loss loss, WorkerState state, TimePoint now);
  /// The worker is back: what its disappearance counted against did not kill it.
  void take_back_charges(WorkerEntry& entry);

 private:
  /// What a loss means for a task that only this worker had, and that may have run.
  enum class Blame { None, Task, Rejected };
  Blame blame(WorkerEntry& entry, TaskRecord& record, Loss loss);
  Blame blame_of_program(WorkerEntry& entry, TaskRecord& record, Loss loss);

  TaskBook* book_;
  WorkerRegistry* workers_;
  Trust* trust_;
};

}  // namespace swarmsmith
