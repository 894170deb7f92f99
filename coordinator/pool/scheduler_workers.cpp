// The scheduler's view of who is there: hellos, losses, and who may be blamed for them.

#include <algorithm>
#include <unordered_set>

#include "coordinator/pool/scheduler.h"

namespace swarmsmith {
namespace {

/// A worker sends this many results at most in a message, so what ran is among its first
/// (slots + 64) leases.
constexpr std::size_t kUnreported = 64;
constexpr int kDeathsOfARejection = 3;
/// Silent losses are mostly the network's: tolerated much longer.
constexpr int kLossesUntilAlone = 2;
constexpr int kLossesUntilRuled = 12;
/// Losses with workers of which nothing is known say nothing of the task. But where nobody can
/// prove himself, since each dies of it, the referee breaks the circle: one such task at a time.
constexpr int kStraysUntilRuled = 6;

}  // namespace

std::string Scheduler::objection_to(const WorkerHello& hello) const {
  if (hello.engine_version != options_.engine_version) {
    return "this campaign runs with version " + std::to_string(options_.engine_version) +
           " of the simulator, the worker on " + hello.host + " has version " +
           std::to_string(hello.engine_version) + ": install the same release on both sides";
  }
  if (!options_.self_test.empty() && hello.self_test != options_.self_test) {
    return "the simulator's self test gives " + hello.self_test + " on " + hello.host +
           " and should give " + options_.self_test +
           ": another build or compiler; its scores would differ";
  }
  return {};
}

void Scheduler::on_hello(PeerId peer, WorkerHello hello, TimePoint now) {
  Principal& principal = principals_.at(principal_of(hello));
  principal.local |= hello.local;
  WorkerEntry* entry = workers_.of_identity(principal.name, hello.identity);
  const WorkerEntry* holder = workers_.of_peer(peer);
  if (holder != nullptr && holder != entry) return;
  if (entry != nullptr && hello.incarnation <= entry->hello.incarnation) {
    // Said twice: the welcome may have been lost. From elsewhere: a replay.
    if (holder == entry && hello.incarnation == entry->hello.incarnation) {
      actions_.emplace_back(SendWelcome{peer, hello.incarnation});
    }
    return;
  }
  const auto refuse = [&](RejectReason reason, const std::string& sentence) {
    actions_.emplace_back(SendReject{peer, hello.incarnation, reason, sentence});
    note("warning", "worker refused", {{"host", hello.host}, {"reason", sentence}}, std::nullopt,
         &principal);
  };
  if (const std::string objection = objection_to(hello); !objection.empty()) {
    return refuse(RejectReason::Build, objection);
  }
  if (entry == nullptr && principal.quarantined) {
    // It was said once who is in quarantine; new ids of it are not worth a row each.
    actions_.emplace_back(SendReject{
        peer, hello.incarnation, RejectReason::Limit,
        "workers of " + principal.name +
            " are in quarantine: see the event \"workers in quarantine\" of the campaign"});
    return;
  }
  if (entry == nullptr && workers_.connected() >= options_.max_workers) {
    return refuse(RejectReason::Limit, "there are " + std::to_string(workers_.connected()) +
                                           " workers already, which is the limit");
  }
  if (entry == nullptr && principal.workers.size() >= options_.max_workers_of_one) {
    return refuse(RejectReason::Limit, "there are " + std::to_string(principal.workers.size()) +
                                           " workers of " + principal.name +
                                           " already, which is the limit for one key and address");
  }
  if (options_.self_test.empty()) options_.self_test = hello.self_test;
  if (entry != nullptr) ++counters_.reconnects;
  if (entry == nullptr) entry = &workers_.add(principal, hello.identity);
  if (entry->connected) workers_.disconnect(*entry);
  entry->hello = std::move(hello);
  workers_.connect(*entry, peer, now);
  set_credit(*entry, 0);
  take_back_charges(*entry);
  adopt(*entry, now);
  entry->hello.holds = {};
  welcome(*entry, now);
}

void Scheduler::welcome(WorkerEntry& entry, TimePoint now) {
  actions_.emplace_back(SendWelcome{entry.peer, entry.hello.incarnation});
  entry.last_sent = now;
  if (draining_) actions_.emplace_back(SendDrain{entry.peer, entry.hello.incarnation});
  actions_.emplace_back(WorkerChanged{row_of(entry, WorkerState::Connected)});
}

/// The worker is alive: what its disappearance counted against did not kill it.
void Scheduler::take_back_charges(WorkerEntry& entry) {
  for (const PackedKey key : std::exchange(entry.charged, {})) {
    TaskRecord* record = leases_.find(key);
    if (record != nullptr && record->deaths > 0) --record->deaths;
  }
}

/// Leases of the worker's last connection that it does not hold went astray; those that it holds,
/// was given by an earlier process, and nobody else has are its own.
void Scheduler::adopt(WorkerEntry& entry, TimePoint now) {
  std::unordered_set<PackedKey> held;
  if (entry.hello.same_scenario) {
    for (const Hold& hold : entry.hello.holds)
      held.insert(hold.key);
  }
  const std::list<PackedKey>& before = leases_.leases_of(entry.number);
  const std::vector<PackedKey> leased(before.rbegin(), before.rend());
  for (const PackedKey key : leased) {
    if (!held.contains(key)) leases_.requeue(*leases_.find(key), entry.number);
  }
  const auto was_given = [&](const Hold& hold) {
    return signer_.is_ours(hold.signature, hold.key, hold.attempt, entry.principal->name);
  };
  for (const Hold& hold : entry.hello.holds) {
    const bool is_over = held.contains(hold.key) && is_done(hold.key);
    if (is_over && was_given(hold)) leases_.loads().linger(entry.number, hold.key, now);
  }
  if (held_ || draining_ || entry.quarantined || !entry.hello.same_scenario) return;
  for (const Hold& hold : entry.hello.holds) {
    TaskRecord* record = leases_.find(hold.key);
    // What must run alone is leased anew, when the worker has nothing else.
    if (record == nullptr || record->lease || record->alone || record->parked) continue;
    if (!was_given(hold) || !signer_.is_of(hold.signature, record->task)) continue;
    leases_.grant(*record, entry.number, now, cost_us(record->task.campaign));
    record->lease->adopted = true;
  }
}

WorkerEntry* Scheduler::heard(const Sender& sender, TimePoint now) {
  latest_ = now;
  WorkerEntry* entry = workers_.of_peer(sender.peer);
  if (entry == nullptr) {
    actions_.emplace_back(SendWhoAreYou{sender.peer});
    return nullptr;
  }
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
  set_credit(*entry, tasks);
}

void Scheduler::on_returned(const Sender& sender, std::span<const PackedKey> keys, TimePoint now) {
  WorkerEntry* entry = heard(sender, now);
  if (entry == nullptr) return;
  // It wants none, then, even if its word about credit got lost: else they would go to and fro.
  if (sender.sequence > entry->last_sequence) {
    entry->last_sequence = sender.sequence;
    set_credit(*entry, 0);
  }
  for (auto key = keys.rbegin(); key != keys.rend(); ++key) {
    leases_.loads().settle(entry->number, *key);
    TaskRecord* record = leases_.find(*key);
    if (record == nullptr || record->lease_of(entry->number) == nullptr) continue;
    note_attempt(*record, entry->number, AttemptOutcome::Returned, now);
    // It may be copied once more: nobody has failed.
    if (record->second) record->copied = false;
    if (leases_.requeue(*record, entry->number)) ++counters_.requeued;
  }
}

void Scheduler::on_goodbye(const Sender& sender, TimePoint now) {
  WorkerEntry* entry = heard(sender, now);
  if (entry != nullptr) lose(*entry, Loss::Left, WorkerState::Left, now);
}

void Scheduler::on_unreachable(PeerId peer, TimePoint now, std::span<const PackedKey> undelivered) {
  WorkerEntry* entry = workers_.of_peer(peer);
  if (entry == nullptr) return;
  // What the worker never got did not kill it.
  for (auto key = undelivered.rbegin(); key != undelivered.rend(); ++key) {
    leases_.loads().settle(entry->number, *key);
    TaskRecord* record = leases_.find(*key);
    if (record == nullptr || record->lease_of(entry->number) == nullptr) continue;
    if (record->second) record->copied = false;
    if (leases_.requeue(*record, entry->number)) ++counters_.requeued;
  }
  const bool closed = now - entry->last_heard < options_.silence;
  lose(*entry, closed ? Loss::Death : Loss::Silence, WorkerState::Lost, now);
}

void Scheduler::on_refused(PeerId peer, TimePoint now) {
  WorkerEntry* entry = workers_.of_peer(peer);
  if (entry != nullptr) lose(*entry, Loss::Left, WorkerState::Refused, now);
}

void Scheduler::lose(WorkerEntry& entry, Loss loss, WorkerState state, TimePoint now) {
  const std::list<PackedKey>& leases = leases_.leases_of(entry.number);
  const std::vector<PackedKey> keys(leases.begin(), leases.end());
  const std::size_t suspects = static_cast<std::size_t>(entry.hello.slots) + kUnreported;
  // What is lost with strangers, again and again, does not keep others from their turn.
  const bool at_front = loss == Loss::Left || is_proven(*entry.principal);
  workers_.disconnect(entry);
  leases_.loads().set_capacity(entry.number, 0, 0);
  go_astray(*entry.principal, keys.size(), now);
  for (std::size_t i = keys.size(); i-- > 0;) {
    TaskRecord& record = *leases_.find(keys[i]);
    // What was merely queued there is nobody's affair.
    const bool may_have_run = i < suspects && loss != Loss::Left;
    if (may_have_run) note_attempt(record, entry.number, AttemptOutcome::Lost, now);
    // While another worker has it too, nothing is held against the task: if it kills, it will do so
    // there, and there is no third copy then.
    Blame to = Blame::Nobody;
    if (record.second) {
      record.copied = loss == Loss::Death;
    } else if (may_have_run) {
      to = blame(entry, record, loss);
    }
    if (to == Blame::Task) {
      claim(entry, record, Said::What::Died, now);
      continue;
    }
    if (!leases_.requeue(record, entry.number, at_front)) continue;
    ++counters_.requeued;
    if (to == Blame::Rejected) {
      reject(record, entry.number, "its evaluation killed three worker processes");
    } else if (record.strays >= kStraysUntilRuled && cases_.of_nobody() == 0 &&
               !options_.evaluates_programs) {
      record.strays = 0;
      leases_.park(record);
      cases_.open(record.task, std::nullopt, false);
    }
  }
  actions_.emplace_back(WorkerChanged{row_of(entry, state)});
  if (state == WorkerState::Left) return;
  ++counters_.lost_workers;
  note("warning", "worker lost",
       {{"worker", entry.number},
        {"host", entry.hello.host},
        {"how", loss == Loss::Death ? "connection closed" : "silent"},
        {"requeued", static_cast<std::int64_t>(keys.size())}},
       std::nullopt, entry.principal, entry.number);
}

/// Whether the loss says something of a task that only this worker had, and that may have run.
Scheduler::Blame Scheduler::blame(WorkerEntry& entry, TaskRecord& record, Loss loss) {
  if (!is_proven(*entry.principal)) {
    ++record.strays;
    return Blame::Nobody;
  }
  if (options_.evaluates_programs) return blame_of_program(entry, record, loss);
  const Lease& lease = *record.lease;
  if (loss == Loss::Death && lease.alone && lease.began) return Blame::Task;
  ++record.losses;
  if (loss == Loss::Death || record.losses >= kLossesUntilAlone) record.alone = true;
  return lease.alone && record.losses >= kLossesUntilRuled ? Blame::Task : Blame::Nobody;
}

/// Programs run nowhere but on workers. A program that goes wrong does not take its worker with it:
/// its first death is an accident.
Scheduler::Blame Scheduler::blame_of_program(WorkerEntry& entry, TaskRecord& record, Loss loss) {
  const Lease& lease = *record.lease;
  const bool is_death = loss == Loss::Death;
  if (is_death && lease.alone && lease.began) {
    // Where there is somebody else, the same one is not asked three times.
    const std::string& name = entry.principal->name;
    const bool is_new = std::ranges::find(record.died_with, name) == record.died_with.end();
    if (is_new || proven_present() <= record.died_with.size()) {
      ++record.deaths;
      entry.charged.push_back(key_of(record.task));
    }
    if (is_new) record.died_with.push_back(name);
    return record.deaths >= kDeathsOfARejection ? Blame::Rejected : Blame::Nobody;
  }
  ++record.losses;
  if (record.losses >= kLossesUntilAlone) record.alone = true;
  if (!is_death && lease.alone && record.losses >= kLossesUntilRuled) {
    stop(record.task.campaign, "the evaluation of " + name_of(record.task.key) +
                                   " was lost with its worker " + std::to_string(record.losses) +
                                   " times");
  }
  return Blame::Nobody;
}

/// Principals that have proved themselves and are there.
std::size_t Scheduler::proven_present() const {
  return static_cast<std::size_t>(std::ranges::count_if(principals_.all(), [&](const auto& each) {
    return is_proven(each.second) && std::ranges::any_of(each.second.workers, [&](auto number) {
             const auto at = workers_.all().find(number);
             return at != workers_.all().end() && at->second.usable();
           });
  }));
}

void Scheduler::on_began(const Sender& sender, PackedKey key, TimePoint now) {
  WorkerEntry* entry = heard(sender, now);
  if (entry == nullptr) return;
  TaskRecord* record = leases_.find(key);
  Lease* lease = record == nullptr ? nullptr : record->lease_of(entry->number);
  if (lease != nullptr) lease->began = true;
}

}  // namespace swarmsmith
