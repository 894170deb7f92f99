#include "coordinator/scheduler.h"

#include <algorithm>
#include <unordered_set>

#include "base/assert.h"
#include "target/runner.h"

namespace swarmsmith {
namespace {

/// A worker sends this many results at most in a message, so what ran is among its first
/// (slots + 64) leases.
constexpr std::size_t kUnreported = 64;
constexpr int kDeathsOfARejection = 3;
constexpr int kFailuresOfARejection = 2;
/// Silent losses are mostly the network's: tolerated much longer, and never a rejection.
constexpr int kLossesUntilAlone = 2;
constexpr int kLossesUntilStop = 12;

std::string name_of(const EvaluationKey& key) {
  return to_string(key.candidate) + " on pair " + std::to_string(key.pair);
}

double value_of(const DoneEntry& entry) {
  return std::bit_cast<double>(entry.score_bits);
}

}  // namespace

Scheduler::Scheduler(SchedulerOptions options)
    : options_(std::move(options)),
      workers_(options_.first_worker),
      closed_(options_.campaigns.size()),
      estimates_us_(options_.campaigns.size()) {
  SWARMSMITH_ASSERT(!options_.campaigns.empty() && options_.campaigns.size() <= kMaxCampaigns,
                    "a coordinator has some campaigns, and not too many for its keys");
}

void Scheduler::know(std::uint32_t campaign, std::span<const StoredScore> known) {
  for (const StoredScore& score : known) {
    done_.insert(pack(score.key, campaign), score.status, score.score, score.state_digest);
  }
}

void Scheduler::add(std::vector<Task> tasks) {
  for (Task& task : tasks) {
    if (TaskRecord* record = leases_.find(key_of(task)); record != nullptr) {
      SWARMSMITH_ASSERT(record->task.ahead && !task.ahead, "a task is wanted once");
      leases_.promote(*record, latest_);
      continue;
    }
    // Look-ahead whose outcome was told after it became wanted and before this was said.
    if (done_.find(key_of(task)) != nullptr) continue;
    leases_.add(std::move(task), latest_);
  }
}

void Scheduler::drop(std::span<const PackedKey> keys) {
  for (const PackedKey key : keys) {
    const TaskRecord* record = leases_.find(key);
    if (record != nullptr && record->task.ahead && !record->lease) leases_.remove(key);
  }
}

std::vector<SchedulerAction> Scheduler::take_actions() {
  return std::exchange(actions_, {});
}

const WorkerEntry* Scheduler::connected_worker(WorkerNumber number) {
  const WorkerEntry* entry = workers_.of_number(number);
  return entry != nullptr && entry->connected ? entry : nullptr;
}

void Scheduler::note(const char* severity, const char* kind,
                     std::initializer_list<EventField> fields,
                     std::optional<std::uint32_t> campaign) {
  actions_.emplace_back(
      Noted{campaign, {.severity = severity, .kind = kind, .text = event_text(fields)}});
}

void Scheduler::stop(std::uint32_t campaign, const std::string& reason) {
  // What a program wrote may be long; it is in the table of failures.
  note("error", "campaign stopped", {{"reason", reason.substr(0, reason.find('\n'))}}, campaign);
  actions_.emplace_back(StopCampaign{campaign, reason});
}

void Scheduler::forget(std::uint32_t campaign) {
  stopped_.insert(campaign);
  leases_.remove_all(campaign);
  audits_.forget(campaign);
}

// --- who is there ---

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
  WorkerEntry* entry = workers_.of_identity(hello.identity);
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
    note("warning", "worker refused", {{"host", hello.host}, {"reason", sentence}});
  };
  if (const std::string objection = objection_to(hello); !objection.empty()) {
    return refuse(RejectReason::Build, objection);
  }
  if (entry == nullptr && workers_.connected() >= options_.max_workers) {
    return refuse(RejectReason::Limit, "there are " + std::to_string(workers_.connected()) +
                                           " workers already, which is the limit");
  }
  if (options_.self_test.empty()) options_.self_test = hello.self_test;
  if (entry != nullptr) ++counters_.reconnects;
  if (entry == nullptr) entry = &workers_.add(hello.identity);
  if (entry->connected) workers_.disconnect(*entry);
  entry->hello = std::move(hello);
  workers_.connect(*entry, peer, now);
  set_credit(*entry, 0);
  take_back_charges(*entry);
  adopt(*entry, now);
  welcome(*entry, now);
}

void Scheduler::welcome(WorkerEntry& entry, TimePoint now) {
  actions_.emplace_back(SendWelcome{entry.peer, entry.hello.incarnation});
  entry.last_sent = now;
  if (draining_) actions_.emplace_back(SendDrain{entry.peer, entry.hello.incarnation});
  actions_.emplace_back(
      WorkerChanged{row_of(entry, entry.quarantined ? "quarantined" : "connected")});
}

/// The worker is alive: what its disappearance counted against did not kill it.
void Scheduler::take_back_charges(WorkerEntry& entry) {
  for (const PackedKey key : std::exchange(entry.charged, {})) {
    TaskRecord* record = leases_.find(key);
    if (record != nullptr && record->deaths > 0) --record->deaths;
  }
}

/// Leases of the worker's last connection that it does not hold went astray; those that it holds
/// and nobody else has are its own.
void Scheduler::adopt(WorkerEntry& entry, TimePoint now) {
  std::unordered_set<PackedKey> held;
  if (entry.hello.same_scenario) held.insert(entry.hello.holds.begin(), entry.hello.holds.end());
  const std::list<PackedKey>& before = leases_.leases_of(entry.number);
  const std::vector<PackedKey> leased(before.rbegin(), before.rend());
  for (const PackedKey key : leased) {
    if (!held.contains(key)) take_back(*leases_.find(key), entry.number);
  }
  for (const PackedKey key : entry.hello.holds) {
    if (held.contains(key) && is_done(key)) leases_.loads().linger(entry.number, key, now);
  }
  if (held_ || draining_ || entry.quarantined || !entry.hello.same_scenario) return;
  for (const PackedKey key : entry.hello.holds) {
    TaskRecord* record = leases_.find(key);
    // What must run alone is leased anew, when the worker has nothing else.
    if (record == nullptr || record->lease || record->alone) continue;
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

void Scheduler::set_credit(WorkerEntry& entry, std::uint32_t credit) {
  entry.credit = std::min(credit, options_.max_credit);
  entry.asked |= credit > 0;
  const auto slots = static_cast<std::size_t>(entry.usable() ? entry.hello.slots : 0);
  leases_.loads().set_capacity(entry.number, slots, slots > 0 ? entry.credit : 0);
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
    note_attempt(*record, entry->number, "returned", now);
    // It may be copied once more: nobody has failed.
    if (record->second) record->copied = false;
    if (take_back(*record, entry->number)) ++counters_.requeued;
  }
}

void Scheduler::on_goodbye(const Sender& sender, TimePoint now) {
  WorkerEntry* entry = heard(sender, now);
  if (entry != nullptr) lose(*entry, Loss::Left, "left", now);
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
    if (take_back(*record, entry->number)) ++counters_.requeued;
  }
  const bool closed = now - entry->last_heard < options_.silence;
  lose(*entry, closed ? Loss::Death : Loss::Silence, "lost", now);
}

void Scheduler::on_refused(PeerId peer, TimePoint now) {
  WorkerEntry* entry = workers_.of_peer(peer);
  if (entry != nullptr) lose(*entry, Loss::Left, "refused", now);
}

void Scheduler::lose(WorkerEntry& entry, Loss loss, const std::string& state, TimePoint now) {
  const std::list<PackedKey>& leases = leases_.leases_of(entry.number);
  const std::vector<PackedKey> keys(leases.begin(), leases.end());
  const std::size_t suspects = static_cast<std::size_t>(entry.hello.slots) + kUnreported;
  workers_.disconnect(entry);
  leases_.loads().set_capacity(entry.number, 0, 0);
  for (std::size_t i = keys.size(); i-- > 0;) {
    TaskRecord& record = *leases_.find(keys[i]);
    const bool is_audit = record.audit;
    // What was merely queued there is nobody's affair.
    const bool may_have_run = i < suspects && loss != Loss::Left;
    if (may_have_run) note_attempt(record, entry.number, "lost", now);
    // While another worker has it too, nothing is held against the task: if it kills, it will do so
    // there, and there is no third copy then.
    if (record.second) {
      record.copied = loss == Loss::Death;
    } else if (may_have_run) {
      suspect(entry, record, loss);
    }
    if (take_back(record, entry.number)) ++counters_.requeued;
    if (is_audit) continue;
    if (record.deaths >= kDeathsOfARejection) {
      reject(record, entry.number, "its evaluation killed three worker processes");
    }
  }
  actions_.emplace_back(WorkerChanged{row_of(entry, state)});
  if (state == "left") return;
  ++counters_.lost_workers;
  note("warning", "worker lost",
       {{"worker", entry.number},
        {"host", entry.hello.host},
        {"how", loss == Loss::Death ? "connection closed" : "silent"},
        {"requeued", static_cast<std::int64_t>(keys.size())}});
}

void Scheduler::suspect(WorkerEntry& entry, TaskRecord& record, Loss loss) {
  if (record.audit) return;
  // A program that goes wrong does not take its worker with it: its first death is an accident.
  const bool accident = options_.evaluates_programs && loss == Loss::Death &&
                        !record.lease->alone && ++record.losses < kLossesUntilAlone;
  if (accident) return;
  if (loss == Loss::Death) {
    if (record.lease->alone) {
      ++record.deaths;
      entry.charged.push_back(key_of(record.task));
    }
    record.alone = true;
  } else if (loss == Loss::Silence) {
    ++record.losses;
    if (record.losses >= kLossesUntilAlone) record.alone = true;
    if (record.lease->alone && record.losses >= kLossesUntilStop) {
      stop(record.task.campaign, "the evaluation of " + name_of(record.task.key) +
                                     " was lost with its worker " + std::to_string(record.losses) +
                                     " times");
    }
  }
}

// --- what comes back ---

void Scheduler::on_results(const Sender& sender, std::span<const WorkerResult> results,
                           TimePoint now) {
  WorkerEntry* entry = heard(sender, now);
  if (entry == nullptr) return;
  SendAcknowledged acknowledged{entry->peer, entry->hello.incarnation, {}};
  for (const WorkerResult& result : results) {
    leases_.loads().settle(entry->number, result.key);
    if (entry->quarantined || stopped_.contains(campaign_of(result.key))) {
      acknowledged.keys.push_back(result.key);
    } else if (result.failure.empty()) {
      on_score(*entry, result, now);
    } else {
      on_failure(*entry, result, acknowledged, now);
    }
  }
  if (!acknowledged.keys.empty()) actions_.emplace_back(std::move(acknowledged));
}

void Scheduler::on_score(WorkerEntry& entry, const WorkerResult& result, TimePoint now) {
  TaskRecord* record = leases_.find(result.key);
  if (record != nullptr && !record->audit) {
    ++entry.done;
    const bool failed_elsewhere = record->avoid != 0 && record->avoid != entry.number;
    if (failed_elsewhere) strike(record->avoid, now);
    const std::int64_t every = options_.evaluates_programs ? 0 : policy_of(*record).audit_every;
    if (!result.rejected && Audits::chooses(result.key, every)) {
      audits_.open(record->task, {entry.number, result.score, result.state_digest});
    }
    learn(record->task.campaign, result.wall_us);
    note_second_copy(*record, entry.number, now);
    const Lease* lease = record->lease_of(entry.number);
    CampaignMeters& meters = leases_.meters(record->task.campaign);
    meters.evaluation.observe(std::chrono::microseconds(std::max<std::int64_t>(result.wall_us, 0)));
    if (lease != nullptr) meters.round_trip.observe(now - lease->granted);
    accept(
        {.key = record->task.key,
         .campaign = record->task.campaign,
         .status = result.rejected ? EvaluationStatus::Rejected : EvaluationStatus::Ok,
         .score = result.rejected ? 0 : result.score,
         .state_digest = result.state_digest,
         .wall_us = result.wall_us,
         .worker = entry.number,
         .attempt = lease != nullptr ? lease->attempt : std::max<std::int64_t>(record->attempts, 1),
         .time = result.time});
    return;
  }
  const bool is_audit = record != nullptr && record->lease_of(entry.number) != nullptr;
  if (is_audit) return on_audited(entry, result, now);
  if (is_done(result.key)) return repeat(entry, result);
  // Wanted later, perhaps: after a restart the race may not have come so far. Not acknowledged, so
  // it comes again.
  ++counters_.unknown;
  const std::uint32_t campaign = campaign_of(result.key);
  if (campaign < closed_.size() && closed_[campaign]) {
    actions_.emplace_back(SendAcknowledged{entry.peer, entry.hello.incarnation, {result.key}});
  }
}

void Scheduler::accept(const Outcome& outcome) {
  const PackedKey key = key_of(outcome);
  leases_.remove(key, outcome.worker);
  done_.insert(key, outcome.status, outcome.score, outcome.state_digest);
  CampaignMeters& meters = leases_.meters(outcome.campaign);
  const bool ok = outcome.status == EvaluationStatus::Ok;
  ++(ok ? counters_.done : counters_.rejected);
  ++(ok ? meters.done : meters.rejected);
  actions_.emplace_back(OutcomeAccepted{outcome});
}

/// A row for the copy that came second, or will.
void Scheduler::note_second_copy(TaskRecord& record, WorkerNumber by, TimePoint now) {
  if (!record.second) return;
  for (const Lease* lease : {&*record.lease, &*record.second}) {
    if (lease->worker != by) note_attempt(key_of(record.task), *lease, "second copy", now);
  }
}

void Scheduler::repeat(const WorkerEntry& entry, const WorkerResult& result) {
  ++counters_.duplicates;
  actions_.emplace_back(OutcomeRepeated{result.key, entry.number});
  // Two runs of a program may differ, in its time at least: the first one counts.
  if (options_.evaluates_programs) return;
  if (const DoneEntry* known = done_.find(result.key)) judge(entry, *known, result);
}

/// Another result with other bits: the campaign is not deterministic, or somebody lies.
void Scheduler::judge(const WorkerEntry& entry, const DoneEntry& known,
                      const WorkerResult& result) {
  if (DoneTable::same(known, EvaluationStatus::Ok, result.score, result.state_digest)) return;
  ++counters_.conflicts;
  const EvaluationKey key = unpack(result.key);
  actions_.emplace_back(ConflictFound{campaign_of(result.key),
                                      {.key = key,
                                       .kept_score = value_of(known),
                                       .other_score = result.score,
                                       .other_state_digest = result.state_digest,
                                       .other_worker = entry.number}});
  note("error", "not deterministic",
       {{"evaluation", name_of(key)}, {"worker", entry.number}, {"host", entry.hello.host}},
       campaign_of(result.key));
}

void Scheduler::on_failure(WorkerEntry& entry, const WorkerResult& result,
                           SendAcknowledged& acknowledged, TimePoint now) {
  // A failure is told once: for the lease under which it ran. Nothing is written, so the worker
  // may forget it at once.
  acknowledged.keys.push_back(result.key);
  TaskRecord* record = leases_.find(result.key);
  const Lease* lease = record == nullptr ? nullptr : record->lease_of(entry.number);
  if (lease == nullptr || (!lease->adopted && lease->attempt != result.attempt)) return;
  ++entry.failed;
  ++counters_.failed;
  ++leases_.meters(record->task.campaign).no_score;
  note("warning", "evaluation failed",
       {{"evaluation", name_of(record->task.key)},
        {"worker", entry.number},
        {"reason", result.failure}},
       record->task.campaign);
  actions_.emplace_back(FailureKept{record->task.campaign,
                                    {.key = record->task.key,
                                     .attempt = lease->attempt,
                                     .worker = entry.number,
                                     .reason = result.failure,
                                     .command = result.details.command,
                                     .output = result.details.output,
                                     .errors = result.details.errors}});
  note_attempt(*record, entry.number, "failed", now);
  if (record->audit) {
    // The strike may send the worker to quarantine, which takes its leases back.
    take_back(*record, entry.number);
    return strike(entry.number, now);
  }
  record->avoid = entry.number;
  if (record->second) {
    // The other copy tells; two of them count once.
    leases_.requeue(*record, entry.number);
    return;
  }
  ++record->failures;
  // A program's worker has tried again by itself, as often as the campaign allows.
  if (options_.evaluates_programs || record->failures >= kFailuresOfARejection) {
    reject(*record, entry.number, result.failure, result.details);
  } else {
    take_back(*record, entry.number);
  }
}

void Scheduler::on_heartbeat(const Sender& sender, std::uint32_t credit,
                             std::span<const RunningReport> running, TimePoint now,
                             const std::optional<SlotReport>& slots) {
  WorkerEntry* entry = heard(sender, now);
  if (entry == nullptr || sender.sequence <= entry->last_sequence) return;
  entry->last_sequence = sender.sequence;
  set_credit(*entry, credit);
  if (slots && slots->slot_us > entry->slot_us) {
    entry->slot_us = slots->slot_us;
    entry->busy_us = slots->busy_us;
  }
  entry->running = running.size();
  for (const RunningReport& report : running) {
    if (leases_.loads().renew_lingering(entry->number, report.key, now)) continue;
    TaskRecord* record = leases_.find(report.key);
    Lease* lease = record == nullptr ? nullptr : record->lease_of(entry->number);
    if (lease == nullptr) continue;
    lease->renewed = now;
    // Of a program the worker itself keeps the time.
    if (options_.evaluates_programs) continue;
    const auto limit = policy_of(*record).task_timeout;
    if (std::chrono::milliseconds(report.elapsed_ms) > limit) on_timeout(*entry, *record, now);
  }
}

/// A time never becomes a score: another try elsewhere, then the end.
void Scheduler::on_timeout(WorkerEntry& entry, TaskRecord& record, TimePoint now) {
  ++entry.failed;
  ++counters_.failed;
  ++leases_.meters(record.task.campaign).timed_out;
  note("warning", "evaluation timed out",
       {{"evaluation", name_of(record.task.key)}, {"worker", entry.number}}, record.task.campaign);
  note_attempt(record, entry.number, "timed out", now);
  if (record.audit) {
    take_back(record, entry.number);
    return strike(entry.number, now);
  }
  record.avoid = entry.number;
  const CampaignPolicy& policy = policy_of(record);
  // Two copies that hang count once.
  const bool is_last = !record.second && ++record.timeouts > policy.retries;
  record.troubled = is_last && record.task.ahead;
  leases_.requeue(record, entry.number);
  if (is_last && !record.task.ahead) {
    stop(record.task.campaign,
         "the evaluation of " + name_of(record.task.key) + " took longer than " +
             std::to_string(
                 std::chrono::duration_cast<std::chrono::seconds>(policy.task_timeout).count()) +
             " s in " + std::to_string(record.timeouts) +
             " attempts: raise task_timeout_s, or retries");
  }
}

/// `record` is gone afterwards, unless the campaign stops.
void Scheduler::reject(TaskRecord& record, WorkerNumber worker, const std::string& reason,
                       const FailureDetails& details) {
  const EvaluationKey key = record.task.key;
  if (policy_of(record).stop_on_failure && record.task.ahead) {
    // Nobody may ever ask for it: no reason to stop before somebody does.
    record.troubled = true;
    leases_.requeue(record, worker);
    return;
  }
  if (policy_of(record).stop_on_failure) {
    std::string message = "the evaluation of " + name_of(key) + " failed: ";
    message += message_of(reason, details);
    if (!details.command.empty()) message += "It is kept in the table `failure` of the store.";
    return stop(record.task.campaign, message);
  }
  note("warning", "evaluation rejected", {{"evaluation", name_of(key)}, {"reason", reason}},
       record.task.campaign);
  accept({.key = key,
          .campaign = record.task.campaign,
          .status = EvaluationStatus::Rejected,
          .worker = worker,
          .attempt = std::max<std::int64_t>(record.attempts, 1)});
}

}  // namespace swarmsmith
