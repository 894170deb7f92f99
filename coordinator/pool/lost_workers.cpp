#include "coordinator/pool/lost_workers.h"

#include <algorithm>
#include <utility>

#include "base/assert.h"
#include "storage/answer.h"

namespace swarmsmith {
namespace {

/// A worker sends at most this many results in a message, so the tasks that were running are among
/// its first (slots + 64) leases.
constexpr std::size_t kUnreported = 64;
constexpr int kDeathsOfARejection = 3;
/// Silent losses are usually caused by the network, so many more are tolerated.
constexpr int kLossesUntilAlone = 2;
constexpr int kLossesUntilRuled = 12;
/// A loss with an unknown worker says nothing about the task. But if the task kills every worker
/// before it can prove itself, only the referee can end this; it takes one such task at a time.
constexpr int kStraysUntilRuled = 6;

}  // namespace

void LostWorkers::take_back_charges(WorkerEntry& entry) {
  for (const PackedKey key : std::exchange(entry.charged, {})) {
    TaskRecord* record = book_->leases.find(key);
    if (record != nullptr && record->deaths > 0) --record->deaths;
  }
}

void LostWorkers::lose(WorkerEntry& entry, Loss loss, WorkerState state, TimePoint now) {
  SWARMSMITH_ASSERT(entry.connected, "only a connected worker can be lost");
  const std::list<PackedKey>& leases = book_->leases.leases_of(entry.number);
  const std::vector<PackedKey> keys(leases.begin(), leases.end());
  const std::size_t suspects = static_cast<std::size_t>(entry.hello.slots) + kUnreported;
  // Tasks that are lost again and again with strangers' workers must not delay other tasks.
  const bool at_front = loss == Loss::Left || entry.principal->is_proven();
  workers_->disconnect(entry);
  book_->leases.loads().set_capacity(entry.number, 0, 0);
  trust_->go_astray(*entry.principal, keys.size(), now);
  // From last to first: each goes to the front of its queue, so they are leased again in order.
  for (std::size_t i = keys.size(); i-- > 0;) {
    TaskRecord& record = *book_->leases.find(keys[i]);
    // A task that was only queued there did not kill the worker, and the worker did not fail at it.
    const bool may_have_run = i < suspects && loss != Loss::Left;
    if (may_have_run) book_->note_attempt(record, entry.number, AttemptOutcome::Lost, now);
    // While another worker has a copy, the loss does not count against the task: if the task kills
    // workers, it will kill that one too, and then there is no third copy.
    Blame to = Blame::None;
    if (record.second) {
      record.copied = loss == Loss::Death;
    } else if (may_have_run) {
      to = blame(entry, record, loss);
    }
    if (to == Blame::Task) {
      trust_->claim(entry, record, Said::What::Died);
      continue;
    }
    if (!book_->leases.requeue(record, entry.number, at_front)) continue;
    ++book_->counters.requeued;
    if (to == Blame::Rejected) {
      book_->reject(record, entry.number, "its evaluation killed three worker processes");
    } else if (record.strays >= kStraysUntilRuled) {
      trust_->rule_on_stray(record);
    }
  }
  SWARMSMITH_ASSERT(book_->leases.leases_of(entry.number).empty(), "a lost worker has no leases");
  book_->act(WorkerChanged{row_of(entry, state)});
  if (state == WorkerState::Left) return;
  ++book_->counters.lost_workers;
  book_->note("warning", "worker lost",
              {{"worker", entry.number},
               {"host", entry.hello.host},
               {"how", loss == Loss::Death ? "connection closed" : "silent"},
               {"requeued", static_cast<std::int64_t>(keys.size())}},
              std::nullopt, entry.principal, entry.number);
}

/// Whether the loss counts against a task that only this worker had and that may have been running.
LostWorkers::Blame LostWorkers::blame(WorkerEntry& entry, TaskRecord& record, Loss loss) {
  SWARMSMITH_ASSERT(record.lease && !record.second,
                    "only the loss of a task's single holder is blamed");
  if (!entry.principal->is_proven()) {
    ++record.strays;
    return Blame::None;
  }
  if (book_->options.evaluates_programs) return blame_of_program(entry, record, loss);
  const Lease& lease = *record.lease;
  if (loss == Loss::Death && lease.alone && lease.began) return Blame::Task;
  ++record.losses;
  if (loss == Loss::Death || record.losses >= kLossesUntilAlone) record.alone = true;
  return lease.alone && record.losses >= kLossesUntilRuled ? Blame::Task : Blame::None;
}

/// Programs run only on workers. A failing program does not kill its worker, so the task's first
/// loss counts as an accident.
LostWorkers::Blame LostWorkers::blame_of_program(WorkerEntry& entry, TaskRecord& record,
                                                 Loss loss) {
  const Lease& lease = *record.lease;
  const bool is_death = loss == Loss::Death;
  if (is_death && lease.alone && lease.began) {
    // If there are other workers, deaths with the same principal count only once.
    const std::string& name = entry.principal->name;
    const bool is_new = std::ranges::find(record.died_with, name) == record.died_with.end();
    if (is_new || trust_->proven_present() <= record.died_with.size()) {
      ++record.deaths;
      entry.charged.push_back(key_of(record.task));
    }
    if (is_new) record.died_with.push_back(name);
    return record.deaths >= kDeathsOfARejection ? Blame::Rejected : Blame::None;
  }
  ++record.losses;
  if (record.losses >= kLossesUntilAlone) record.alone = true;
  if (!is_death && lease.alone && record.losses >= kLossesUntilRuled) {
    book_->stop(record.task.campaign, "the evaluation of " + name_of(record.task.key) +
                                          " was lost with its worker " +
                                          std::to_string(record.losses) + " times");
  }
  return Blame::None;
}

}  // namespace swarmsmith
