// The scheduler's view of who can be believed: attempts, audits, quarantine.

#include <algorithm>

#include "coordinator/in_turn.h"
#include "coordinator/scheduler.h"
#include "storage/answer.h"

namespace swarmsmith {
namespace {

/// Failing at one of so many evaluations is more than bad luck.
constexpr std::int64_t kOneOf = 20;

}  // namespace

void Scheduler::note_attempt(PackedKey key, const Lease& lease, const char* outcome,
                             TimePoint now) {
  const auto held = std::chrono::duration_cast<std::chrono::milliseconds>(now - lease.granted);
  actions_.emplace_back(AttemptEnded{campaign_of(key),
                                     {.key = unpack(key),
                                      .attempt = lease.attempt,
                                      .worker = lease.worker,
                                      .held_ms = held.count(),
                                      .outcome = outcome}});
}

void Scheduler::note_attempt(TaskRecord& record, WorkerNumber worker, const char* outcome,
                             TimePoint now) {
  note_attempt(key_of(record.task), *record.lease_of(worker), outcome, now);
}

bool Scheduler::take_back(TaskRecord& record, WorkerNumber worker) {
  if (!record.audit) return leases_.requeue(record, worker);
  const PackedKey key = key_of(record.task);
  leases_.remove(key);
  audits_.give_back(key);
  return false;
}

bool Scheduler::is_auditing() const {
  if (audits_.empty()) return false;
  std::vector<WorkerNumber> usable;
  for (const auto& [number, entry] : workers_.all()) {
    if (entry.usable()) usable.push_back(number);
  }
  return audits_.can_go_on(usable);
}

/// Audits are few, and go before anything else: a liar should be known soon.
void Scheduler::dispatch_audits(TimePoint now) {
  if (audits_.waiting() == 0) return;
  in_turn(leases_.loads().with_room(), turn_, [&](WorkerNumber number) {
    WorkerEntry& entry = *workers_.of_number(number);
    if (entry.reserved) return true;
    SendTasks message{entry.peer, entry.hello.incarnation, {}};
    while (leases_.loads().of(number).room() > 0) {
      std::optional<Task> task = audits_.take_for(number);
      if (!task) break;
      const PackedKey key = key_of(*task);
      // As with look-ahead, no race waits for it.
      task->ahead = true;
      leases_.add(std::move(*task));
      TaskRecord& record = *leases_.find(key);
      record.audit = true;
      leases_.grant(record, number, now);
      put_task(entry, record, message, now);
    }
    if (!message.tasks.empty()) send_tasks(entry, message, now);
    return audits_.waiting() > 0;
  });
}

void Scheduler::on_audited(WorkerEntry& entry, const WorkerResult& result, TimePoint now) {
  ++counters_.audited;
  // Nothing is written for it, so that the worker may forget it when the first one is on disk.
  actions_.emplace_back(OutcomeRepeated{result.key, entry.number});
  // The design may be over, and its outcomes forgotten; the audit remembers its own.
  const Audits::Word& kept = audits_.kept(result.key);
  judge(entry, DoneTable::entry_of(result.key, EvaluationStatus::Ok, kept.score, kept.state_digest),
        result);
  const Audits::Verdict verdict =
      audits_.hear(result.key, {entry.number, result.score, result.state_digest});
  note_attempt(*leases_.find(result.key), entry.number, verdict.differs ? "conflict" : "audited",
               now);
  leases_.remove(result.key, entry.number);
  if (verdict.no_two_agree) {
    note("error", "three results of one evaluation",
         {{"evaluation", to_string(unpack(result.key))}, {"worker", entry.number}},
         campaign_of(result.key));
  }
  if (!verdict.outvoted) return;
  WorkerEntry* liar = workers_.of_number(*verdict.outvoted);
  // The result that was kept is the wrong one.
  if (verdict.differs) {
    note("error", "a stored score is wrong",
         {{"evaluation", to_string(unpack(result.key))},
          {"worker", *verdict.outvoted},
          {"advice", "run the campaign again into a new store"}},
         campaign_of(result.key));
  }
  if (liar != nullptr) quarantine(*liar, "two other workers agree on another result", now);
}

void Scheduler::strike(WorkerNumber worker, TimePoint now) {
  WorkerEntry* entry = workers_.of_number(worker);
  if (entry == nullptr || options_.quarantine_after == 0) return;
  ++entry->strikes;
  const bool often = entry->strikes >= options_.quarantine_after &&
                     entry->strikes * kOneOf >= entry->done + entry->failed;
  if (often) quarantine(*entry, "fails at evaluations that succeed elsewhere", now);
}

void Scheduler::quarantine(WorkerEntry& entry, const std::string& reason, TimePoint now) {
  if (entry.quarantined) return;
  const std::list<PackedKey>& leases = leases_.leases_of(entry.number);
  const std::vector<PackedKey> keys(leases.rbegin(), leases.rend());
  for (const PackedKey key : keys) {
    TaskRecord& record = *leases_.find(key);
    note_attempt(record, entry.number, "returned", now);
    if (take_back(record, entry.number)) ++counters_.requeued;
  }
  workers_.quarantine(entry);
  set_credit(entry, 0);
  ++counters_.quarantined;
  actions_.emplace_back(WorkerChanged{row_of(entry, "quarantined")});
  note("error", "worker in quarantine",
       {{"worker", entry.number},
        {"host", entry.hello.host},
        {"reason", reason},
        {"results in the store", entry.done}});
  if (workers_.trusted() == 0) note("error", "no worker left that is trusted", {});
}

}  // namespace swarmsmith
