// The scheduler's input: tasks, and the messages of workers.

#include "coordinator/pool/scheduler.h"

#include <algorithm>
#include <unordered_set>

#include "base/assert.h"
#include "storage/answer.h"

namespace swarmsmith {

Scheduler::Scheduler(SchedulerOptions options)
    : book_(std::make_unique<TaskBook>(std::move(options))),
      workers_(std::make_unique<WorkerRegistry>(book_->options.first_worker)),
      trust_(std::make_unique<Trust>(*book_, *workers_)),
      lost_(*book_, *workers_, *trust_),
      self_test_(book_->options.self_test) {}

void Scheduler::add(std::vector<Task> tasks) {
  for (Task& task : tasks) {
    if (TaskRecord* record = book_->leases.find(key_of(task)); record != nullptr) {
      SWARMSMITH_ASSERT(record->task.ahead && !task.ahead, "a race asks for a task once");
      book_->leases.promote(*record, book_->now);
      continue;
    }
    // A look-ahead task that became wanted, but its outcome came before this call.
    if (book_->done.find(key_of(task)) != nullptr) continue;
    book_->leases.add(std::move(task), book_->now);
  }
}

void Scheduler::drop(std::span<const PackedKey> keys) {
  for (const PackedKey key : keys) {
    const TaskRecord* record = book_->leases.find(key);
    // A leased one may be running: its result is still accepted.
    if (record != nullptr && record->task.ahead && !record->lease) book_->leases.remove(key);
  }
}

const WorkerEntry* Scheduler::connected_worker(WorkerNumber number) {
  const WorkerEntry* entry = workers_->of_number(number);
  return entry != nullptr && entry->connected ? entry : nullptr;
}

void Scheduler::forget(std::uint32_t campaign) {
  book_->forget(campaign);
  trust_->forget(campaign);
}

void Scheduler::on_results(const Sender& sender, std::span<const Result> results, TimePoint now) {
  WorkerEntry* entry = heard(sender, now);
  if (entry == nullptr) return;
  SendAcknowledged acknowledged{entry->peer, entry->hello.incarnation, {}};
  for (const Result& result : results) {
    // A result counts if its worker has, or had, a lease for it: else any client could send scores.
    // A refused one is acknowledged, so that the worker does not send it again.
    const bool may = trust_->may_answer(*entry, result);
    if (!may) ++book_->counters.unleased;
    if (!may || entry->quarantined || book_->is_stopped(campaign_of(result.key))) {
      acknowledged.keys.push_back(result.key);
    } else if (result.failure.empty()) {
      on_score(*entry, result, now);
    } else {
      // A failure is reported once, for the lease under which it ran. No row waits for it, so the
      // worker may forget it at once.
      acknowledged.keys.push_back(result.key);
      on_failure(*entry, result, now);
    }
    // When the tasks of a stopped campaign are forgotten, a worker's slots count as busy until it
    // reports on those that it has. It does not report on this one again.
    TaskRecord* record = book_->leases.find(result.key);
    if (record != nullptr && record->lease_of(entry->number) != nullptr &&
        book_->is_stopped(campaign_of(result.key)))
      book_->leases.remove(result.key, entry->number);
  }
  if (!acknowledged.keys.empty()) book_->act(std::move(acknowledged));
}

void Scheduler::on_score(WorkerEntry& entry, const Result& result, TimePoint now) {
  if (TaskRecord* record = book_->leases.find(result.key); record != nullptr) {
    return trust_->on_score(entry, *record, result, now);
  }
  if (book_->is_done(result.key)) return trust_->on_repeated(entry, result);
  // It may be wanted later: after a restart the race may not have reached it yet. It is not
  // acknowledged, so it comes again.
  ++book_->counters.unknown;
  if (book_->is_closed(campaign_of(result.key))) {
    book_->act(SendAcknowledged{entry.peer, entry.hello.incarnation, {result.key}});
  }
}

void Scheduler::on_failure(WorkerEntry& entry, const Result& result, TimePoint now) {
  TaskRecord* record = book_->leases.find(result.key);
  const Lease* lease = record == nullptr ? nullptr : record->lease_of(entry.number);
  // A failure of an earlier lease says nothing about the present one.
  if (lease == nullptr || (!lease->adopted && lease->attempt != result.attempt)) return;
  ++entry.failed;
  ++book_->counters.failed;
  ++book_->leases.meters(record->task.campaign).no_score;
  book_->note("warning", "evaluation failed",
              {{"evaluation", name_of(record->task.key)},
               {"worker", entry.number},
               {"reason", result.failure}},
              record->task.campaign, entry.principal, entry.number);
  book_->act(FailureKept{record->task.campaign,
                         {.key = record->task.key,
                          .attempt = lease->attempt,
                          .worker = entry.number,
                          .reason = result.failure,
                          .command = result.details.command,
                          .output = result.details.output,
                          .errors = result.details.errors}});
  book_->note_attempt(*record, entry.number, AttemptOutcome::Failed, now);
  if (!book_->options.evaluates_programs) return trust_->claim(entry, *record, Said::What::NoScore);
  // The worker of a program has repeated the call itself, as often as the campaign allows.
  book_->reject(*record, entry.number, result.failure, result.details);
}

void Scheduler::on_heartbeat(const Sender& sender, std::uint32_t credit,
                             std::span<const RunningReport> running, TimePoint now,
                             const std::optional<SlotReport>& slots) {
  WorkerEntry* entry = heard(sender, now);
  if (entry == nullptr || sender.sequence <= entry->last_sequence) return;
  entry->last_sequence = sender.sequence;
  trust_->set_credit(*entry, credit);
  if (slots && slots->slot_us > entry->slot_us) {
    entry->slot_us = slots->slot_us;
    entry->busy_us = slots->busy_us;
  }
  entry->running = running.size();
  for (const RunningReport& report : running) {
    if (book_->leases.loads().renew_lingering(entry->number, report.key, now)) continue;
    TaskRecord* record = book_->leases.find(report.key);
    Lease* lease = record == nullptr ? nullptr : record->lease_of(entry->number);
    if (lease == nullptr) continue;
    lease->renewed = now;
    lease->began = true;
    // For a program, the worker itself limits the time.
    if (book_->options.evaluates_programs) continue;
    const auto limit = book_->policy_of(*record).task_timeout;
    if (std::chrono::milliseconds(report.elapsed_ms) > limit) on_timeout(*entry, *record, now);
  }
}

/// A time-out never becomes a score: first another worker tries, and finally the referee.
void Scheduler::on_timeout(WorkerEntry& entry, TaskRecord& record, TimePoint now) {
  ++entry.failed;
  ++book_->counters.failed;
  ++book_->leases.meters(record.task.campaign).timed_out;
  book_->note("warning", "evaluation timed out",
              {{"evaluation", name_of(record.task.key)}, {"worker", entry.number}},
              record.task.campaign, entry.principal, entry.number);
  book_->note_attempt(record, entry.number, AttemptOutcome::TimedOut, now);
  record.avoid = entry.number;
  // If both copies hang, that counts once.
  const bool is_last = !record.second && ++record.timeouts > book_->policy_of(record).retries;
  if (is_last) return trust_->claim(entry, record, Said::What::NoScore);
  book_->leases.requeue(record, entry.number);
}

std::string Scheduler::objection_to(const WorkerHello& hello) const {
  // Another version or self test may give other bits, so this worker must not evaluate anything
  // (orchestration facts, 5 "Handshake").
  if (hello.engine_version != book_->options.engine_version) {
    return "this campaign runs with version " + std::to_string(book_->options.engine_version) +
           " of the simulator, the worker on " + hello.host + " has version " +
           std::to_string(hello.engine_version) + ": install the same release on both sides";
  }
  if (!self_test_.empty() && hello.self_test != self_test_) {
    return "the simulator's self test gives " + hello.self_test + " on " + hello.host +
           " and should give " + self_test_ +
           ": another build or compiler; its scores would differ";
  }
  return {};
}

void Scheduler::on_hello(PeerId peer, WorkerHello hello, TimePoint now) {
  Principal& principal = trust_->principal_of(hello);
  WorkerEntry* entry = workers_->of_identity(principal.name, hello.identity);
  const WorkerEntry* holder = workers_->of_peer(peer);
  // One connection is one worker.
  if (holder != nullptr && holder != entry) return;
  if (entry != nullptr && hello.incarnation <= entry->hello.incarnation) {
    // A repeated hello: the welcome may have been lost. From another connection, it is a replay.
    if (holder == entry && hello.incarnation == entry->hello.incarnation) {
      book_->act(SendWelcome{peer, hello.incarnation});
    }
    return;
  }
  const auto refuse = [&](RejectReason reason, const std::string& sentence) {
    book_->act(SendReject{peer, hello.incarnation, reason, sentence});
    book_->note("warning", "worker refused", {{"host", hello.host}, {"reason", sentence}},
                std::nullopt, &principal);
  };
  if (const std::string objection = objection_to(hello); !objection.empty()) {
    return refuse(RejectReason::Build, objection);
  }
  if (const Principal::Cause* cause = trust_->cause_against(principal, hello.identity);
      entry == nullptr && cause != nullptr) {
    // An event has already reported the quarantine; its new ids are not worth a row each.
    book_->act(SendReject{peer, hello.incarnation, RejectReason::Limit,
                          sentence_of_quarantine(principal, *cause)});
    return;
  }
  if (entry == nullptr && workers_->connected() >= book_->options.max_workers) {
    return refuse(RejectReason::Limit, "there are " + std::to_string(workers_->connected()) +
                                           " workers already, the limit");
  }
  if (entry == nullptr && principal.workers.size() >= book_->options.max_workers_of_one) {
    return refuse(RejectReason::Limit, "there are " + std::to_string(principal.workers.size()) +
                                           " workers of " + principal.name +
                                           " already, which is the limit for one key and address");
  }
  if (self_test_.empty()) self_test_ = hello.self_test;
  if (entry != nullptr) ++book_->counters.reconnects;
  if (entry == nullptr) entry = &workers_->add(principal, hello.identity);
  if (entry->connected) workers_->disconnect(*entry);
  entry->hello = std::move(hello);
  workers_->connect(*entry, peer, now);
  trust_->set_credit(*entry, 0);
  lost_.take_back_charges(*entry);
  adopt(*entry, now);
  entry->hello.holds = {};
  welcome(*entry, now);
}

void Scheduler::welcome(WorkerEntry& entry, TimePoint now) {
  book_->act(SendWelcome{entry.peer, entry.hello.incarnation});
  entry.last_sent = now;
  if (draining_) book_->act(SendDrain{entry.peer, entry.hello.incarnation});
  book_->act(WorkerChanged{row_of(entry, WorkerState::Connected)});
  const Principal::Cause* cause = trust_->cause_against(*entry.principal, entry.hello.identity);
  if (entry.quarantined && cause != nullptr) {
    book_->act(SendNotice{entry.peer, entry.hello.incarnation,
                          sentence_of_quarantine(*entry.principal, *cause)});
  }
}

/// Leases from the worker's last connection that it does not hold were lost on the way. It gets a
/// lease of each task that it holds from an earlier process and that no other worker has.
void Scheduler::adopt(WorkerEntry& entry, TimePoint now) {
  std::unordered_set<PackedKey> held;
  if (entry.hello.same_scenario) {
    for (const Hold& hold : entry.hello.holds)
      held.insert(hold.key);
  }
  const std::list<PackedKey>& before = book_->leases.leases_of(entry.number);
  const std::vector<PackedKey> leased(before.rbegin(), before.rend());
  for (const PackedKey key : leased) {
    if (!held.contains(key)) book_->leases.requeue(*book_->leases.find(key), entry.number);
  }
  const auto was_given = [&](const Hold& hold) {
    return trust_->signer().is_ours(hold.signature, hold.key, hold.attempt, entry.principal->name);
  };
  for (const Hold& hold : entry.hello.holds) {
    const bool is_over = held.contains(hold.key) && book_->is_done(hold.key);
    if (is_over && was_given(hold)) book_->leases.loads().linger(entry.number, hold.key, now);
  }
  if (held_ || draining_ || entry.quarantined || !entry.hello.same_scenario) return;
  for (const Hold& hold : entry.hello.holds) {
    TaskRecord* record = book_->leases.find(hold.key);
    // A task that must run alone is leased again later, when the worker has no other task.
    if (record == nullptr || record->lease || record->alone || record->parked) continue;
    if (!was_given(hold) || !trust_->signer().is_of(hold.signature, record->task)) continue;
    book_->leases.grant(*record, entry.number, now, cost_us(record->task.campaign));
    record->lease->adopted = true;
  }
}

WorkerEntry* Scheduler::heard(const Sender& sender, TimePoint now) {
  book_->now = now;
  WorkerEntry* entry = workers_->of_peer(sender.peer);
  if (entry == nullptr) {
    book_->act(SendWhoAreYou{sender.peer});
    return nullptr;
  }
  // A message from before the last hello (docs/protocol.md, "What happens when a message is lost,
  // doubled or late").
  if (entry->hello.incarnation != sender.incarnation) return nullptr;
  entry->last_heard = now;
  return entry;
}

bool Scheduler::on_sign_of_life(const Sender& sender, TimePoint now) {
  return heard(sender, now) != nullptr;
}

void Scheduler::on_credit(const Sender& sender, std::uint32_t tasks, TimePoint now) {
  WorkerEntry* entry = heard(sender, now);
  if (entry == nullptr || sender.sequence <= entry->last_sequence) return;
  entry->last_sequence = sender.sequence;
  trust_->set_credit(*entry, tasks);
}

void Scheduler::on_returned(const Sender& sender, std::span<const PackedKey> keys, TimePoint now) {
  WorkerEntry* entry = heard(sender, now);
  if (entry == nullptr) return;
  // The worker wants no tasks then, even if its credit message was lost; otherwise the tasks would
  // go back and forth.
  if (sender.sequence > entry->last_sequence) {
    entry->last_sequence = sender.sequence;
    trust_->set_credit(*entry, 0);
  }
  for (auto key = keys.rbegin(); key != keys.rend(); ++key) {
    book_->leases.loads().settle(entry->number, *key);
    TaskRecord* record = book_->leases.find(*key);
    if (record == nullptr || record->lease_of(entry->number) == nullptr) continue;
    book_->note_attempt(*record, entry->number, AttemptOutcome::Returned, now);
    // It may be copied again, because no attempt has failed.
    if (record->second) record->copied = false;
    if (book_->leases.requeue(*record, entry->number)) ++book_->counters.requeued;
  }
}

void Scheduler::on_goodbye(const Sender& sender, TimePoint now) {
  WorkerEntry* entry = heard(sender, now);
  if (entry != nullptr) lost_.lose(*entry, Loss::Left, WorkerState::Left, now);
}

void Scheduler::on_unreachable(PeerId peer, TimePoint now, std::span<const PackedKey> undelivered) {
  WorkerEntry* entry = workers_->of_peer(peer);
  if (entry == nullptr) return;
  // Tasks that the worker never received did not kill it.
  for (auto key = undelivered.rbegin(); key != undelivered.rend(); ++key) {
    book_->leases.loads().settle(entry->number, *key);
    TaskRecord* record = book_->leases.find(*key);
    if (record == nullptr || record->lease_of(entry->number) == nullptr) continue;
    if (record->second) record->copied = false;
    if (book_->leases.requeue(*record, entry->number)) ++book_->counters.requeued;
  }
  // It was heard lately, so its connection was closed: the process died. Otherwise its host or
  // network may have failed, which says less about its tasks (docs/protocol.md, "Who is blamed").
  const bool closed = now - entry->last_heard < book_->options.silence;
  lost_.lose(*entry, closed ? Loss::Death : Loss::Silence, WorkerState::Lost, now);
}

void Scheduler::on_refused(PeerId peer, TimePoint now) {
  WorkerEntry* entry = workers_->of_peer(peer);
  if (entry != nullptr) lost_.lose(*entry, Loss::Left, WorkerState::Refused, now);
}

void Scheduler::on_began(const Sender& sender, PackedKey key, TimePoint now) {
  WorkerEntry* entry = heard(sender, now);
  if (entry == nullptr) return;
  TaskRecord* record = book_->leases.find(key);
  Lease* lease = record == nullptr ? nullptr : record->lease_of(entry->number);
  if (lease != nullptr) lease->began = true;
}

}  // namespace swarmsmith
