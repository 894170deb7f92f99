// What comes back to the scheduler: scores, failures, signs of life, time-outs.

#include <algorithm>
#include <bit>

#include "coordinator/pool/scheduler.h"
#include "programs/runner.h"

namespace swarmsmith {
namespace {

double value_of(const DoneEntry& entry) {
  return std::bit_cast<double>(entry.score_bits);
}

}  // namespace

void Scheduler::on_results(const Sender& sender, std::span<const Result> results, TimePoint now) {
  WorkerEntry* entry = heard(sender, now);
  if (entry == nullptr) return;
  SendAcknowledged acknowledged{entry->peer, entry->hello.incarnation, {}};
  for (const Result& result : results) {
    const bool may = may_answer(*entry, result);
    if (!may) ++counters_.unleased;
    if (!may || entry->quarantined || stopped_.contains(campaign_of(result.key))) {
      acknowledged.keys.push_back(result.key);
    } else if (result.failure.empty()) {
      on_score(*entry, result, now);
    } else {
      // A failure is told once: for the lease under which it ran. Nothing is written, so the worker
      // may forget it at once.
      acknowledged.keys.push_back(result.key);
      on_failure(*entry, result, now);
    }
  }
  if (!acknowledged.keys.empty()) actions_.emplace_back(std::move(acknowledged));
}

void Scheduler::on_score(WorkerEntry& entry, const Result& result, TimePoint now) {
  TaskRecord* record = leases_.find(result.key);
  if (record != nullptr) {
    const bool is_claim = result.rejected && !options_.evaluates_programs;
    if (is_claim) {
      // Nothing will be written for its word.
      actions_.emplace_back(SendAcknowledged{entry.peer, entry.hello.incarnation, {result.key}});
      return claim(entry, *record, Said::What::NoScore, now);
    }
    if (is_on_trial(*entry.principal, record->task.campaign)) {
      return hold_back(entry, *record, result, now);
    }
    return take(entry, *record, result, now);
  }
  if (is_done(result.key)) return repeat(entry, result);
  // Wanted later, perhaps: after a restart the race may not have come so far. Not acknowledged, so
  // it comes again.
  ++counters_.unknown;
  const std::uint32_t campaign = campaign_of(result.key);
  if (campaign < closed_.size() && closed_[campaign]) {
    actions_.emplace_back(SendAcknowledged{entry.peer, entry.hello.incarnation, {result.key}});
  }
}

void Scheduler::take(WorkerEntry& entry, TaskRecord& record, const Result& result, TimePoint now) {
  const std::uint32_t campaign = record.task.campaign;
  ++entry.done;
  audit(record, entry, result);
  Principal& principal = *entry.principal;
  ++principal.unchecked_of(campaign);
  if (++principal.taken == 1) update_room(principal);
  const bool failed_elsewhere =
      options_.evaluates_programs && record.avoid != 0 && record.avoid != entry.number;
  if (failed_elsewhere) {
    if (const WorkerEntry* other = workers_.of_number(record.avoid)) strike(*other->principal, now);
  }
  learn(campaign, result.wall_us);
  note_second_copy(record, entry.number, now);
  const Lease* lease = record.lease_of(entry.number);
  CampaignMeters& meters = leases_.meters(campaign);
  meters.evaluation.observe(std::chrono::microseconds(std::max<std::int64_t>(result.wall_us, 0)));
  if (lease != nullptr) meters.round_trip.observe(now - lease->granted);
  accept({.key = record.task.key,
          .campaign = campaign,
          .status = result.rejected ? EvaluationStatus::Rejected : EvaluationStatus::Ok,
          .score = result.rejected ? 0 : result.score,
          .state_digest = result.state_digest,
          .wall_us = result.wall_us,
          .worker = entry.number,
          .attempt = lease != nullptr ? lease->attempt : std::max<std::int64_t>(record.attempts, 1),
          .time = result.time});
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
    if (lease->worker != by)
      note_attempt(key_of(record.task), *lease, AttemptOutcome::SecondCopy, now);
  }
}

void Scheduler::repeat(WorkerEntry& entry, const Result& result) {
  ++counters_.duplicates;
  const DoneEntry* known = done_.find(result.key);
  const auto status = result.rejected ? EvaluationStatus::Rejected : EvaluationStatus::Ok;
  // Two runs of a program may differ, in its time at least: the first one counts.
  const bool is_the_same = known == nullptr || options_.evaluates_programs ||
                           DoneTable::same(*known, status, result.score, result.state_digest);
  if (is_the_same || entry.principal->claims >= Principal::kMostClaims) {
    actions_.emplace_back(OutcomeRepeated{result.key, entry.number});
  } else {
    dispute(entry, *known, result);
  }
}

/// Another result with other bits: of another task, when a crash took away why that one had the
/// key; or the campaign is not deterministic, or somebody lies. That is seen when the campaign has
/// told the task.
void Scheduler::dispute(WorkerEntry& entry, const DoneEntry& known, const Result& result) {
  if (++entry.principal->claims == Principal::kMostClaims) update_room(*entry.principal);
  const bool has_score = !DoneTable::same(known, EvaluationStatus::Rejected, 0, 0);
  disputed_[result.key].push_back(
      {.kept = {.what = has_score ? Said::What::Score : Said::What::NoScore,
                .score = value_of(known),
                .state_digest = known.state_digest,
                .taken = true},
       .other = {.what = result.rejected ? Said::What::NoScore : Said::What::Score,
                 .worker = entry.number,
                 .principal = entry.principal->name,
                 .score = result.score,
                 .state_digest = result.state_digest},
       .signature = result.signature});
  actions_.emplace_back(TaskInDispute{campaign_of(result.key), unpack(result.key)});
}

void Scheduler::on_failure(WorkerEntry& entry, const Result& result, TimePoint now) {
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
       record->task.campaign, entry.principal, entry.number);
  actions_.emplace_back(FailureKept{record->task.campaign,
                                    {.key = record->task.key,
                                     .attempt = lease->attempt,
                                     .worker = entry.number,
                                     .reason = result.failure,
                                     .command = result.details.command,
                                     .output = result.details.output,
                                     .errors = result.details.errors}});
  note_attempt(*record, entry.number, AttemptOutcome::Failed, now);
  if (!options_.evaluates_programs) return claim(entry, *record, Said::What::NoScore, now);
  // A program's worker has tried again by itself, as often as the campaign allows.
  reject(*record, entry.number, result.failure, result.details);
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
    lease->began = true;
    // Of a program the worker itself keeps the time.
    if (options_.evaluates_programs) continue;
    const auto limit = policy_of(*record).task_timeout;
    if (std::chrono::milliseconds(report.elapsed_ms) > limit) on_timeout(*entry, *record, now);
  }
}

/// A time never becomes a score: another try elsewhere, then one by the referee.
void Scheduler::on_timeout(WorkerEntry& entry, TaskRecord& record, TimePoint now) {
  ++entry.failed;
  ++counters_.failed;
  ++leases_.meters(record.task.campaign).timed_out;
  note("warning", "evaluation timed out",
       {{"evaluation", name_of(record.task.key)}, {"worker", entry.number}}, record.task.campaign,
       entry.principal, entry.number);
  note_attempt(record, entry.number, AttemptOutcome::TimedOut, now);
  record.avoid = entry.number;
  // Two copies that hang count once.
  const bool is_last = !record.second && ++record.timeouts > policy_of(record).retries;
  if (is_last) return claim(entry, record, Said::What::NoScore, now);
  leases_.requeue(record, entry.number);
}

/// `record` is gone afterwards, unless the campaign stops.
void Scheduler::reject(TaskRecord& record, WorkerNumber worker, const std::string& reason,
                       const FailureDetails& details) {
  const EvaluationKey key = record.task.key;
  if (policy_of(record).stop_on_failure && record.task.ahead) {
    // Nobody may ever ask for it: no reason to stop before somebody does.
    if (record.lease_of(worker) != nullptr) leases_.requeue(record, worker);
    if (!record.lease) leases_.shelve(record);
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
