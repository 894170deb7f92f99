// The scheduler's view of who can be believed: authority over a task, trials of newcomers, audits,
// strikes, quarantine; attempts for the record.

#include <algorithm>

#include "coordinator/pool/scheduler.h"
#include "storage/answer.h"

namespace swarmsmith {
namespace {

/// Failing at one of so many evaluations is more than bad luck.
constexpr std::int64_t kOneOf = 20;
/// First results of a principal that the referee makes again before any of it counts.
constexpr std::int64_t kTrial = 2;
/// What a worker of a principal that is not known yet holds at most: enough for its trial.
constexpr std::size_t kRoomOnTrial = 64;
/// Of a principal's n-th result, this / n is made again, until that is less than usual.
constexpr double kDenseAtFirst = 4;
/// Strangers that were given so much and have delivered nothing wait, while others work: races wait
/// for what they take. Each further one makes it a second longer.
constexpr std::int64_t kMostAstray = 32;
constexpr std::int64_t kMostSecondsToWait = 300;
/// Audits do not wait for the referee longer than that: later ones are left out.
constexpr double kMostBacklogUs = 2e6;

}  // namespace

void Scheduler::note_attempt(PackedKey key, const Lease& lease, AttemptOutcome outcome,
                             TimePoint now) {
  const auto held = std::chrono::duration_cast<std::chrono::milliseconds>(now - lease.granted);
  actions_.emplace_back(AttemptEnded{campaign_of(key),
                                     {.key = unpack(key),
                                      .attempt = lease.attempt,
                                      .worker = lease.worker,
                                      .held_ms = held.count(),
                                      .outcome = outcome}});
}

void Scheduler::note_attempt(TaskRecord& record, WorkerNumber worker, AttemptOutcome outcome,
                             TimePoint now) {
  note_attempt(key_of(record.task), *record.lease_of(worker), outcome, now);
}

// --- authority ---

bool Scheduler::may_answer(const WorkerEntry& entry, const Result& result) {
  const bool lingered = leases_.loads().settle(entry.number, result.key);
  TaskRecord* record = leases_.find(result.key);
  if (result.signature != 0 && record != nullptr && !signer_.is_of(result.signature, record->task))
    return false;
  if (lingered || (record != nullptr && record->lease_of(entry.number) != nullptr)) return true;
  return signer_.is_ours(result.signature, result.key, result.attempt, entry.principal->name);
}

bool Scheduler::is_proven(const Principal& principal) const {
  return principal.local || principal.taken > 0;
}

bool Scheduler::is_on_trial(const Principal& principal, std::uint32_t campaign) const {
  const bool audits = !options_.evaluates_programs && options_.campaigns[campaign].audit_every > 0;
  return audits && !principal.local && principal.confirmed < kTrial;
}

// --- trials and audits ---

/// The result waits: for the referee's word on it, or on others of its principal.
void Scheduler::hold_back(WorkerEntry& entry, TaskRecord& record, const Result& result,
                          TimePoint now) {
  Principal& principal = *entry.principal;
  const Case* known = cases_.find(result.key);
  const bool is_said = known != nullptr && std::ranges::any_of(known->said, [&](const Said& said) {
                         return said.principal == principal.name;
                       });
  if (record.lease_of(entry.number) != nullptr) leases_.requeue(record, entry.number);
  if (!record.lease) leases_.park(record);
  if (is_said) return;
  principal.waiting.try_emplace(result.key, Principal::Waiting{entry.number, result});
  try_waiting(principal, now);
}

/// Brings as many of its results before the referee as its trial takes.
void Scheduler::try_waiting(Principal& principal, TimePoint now) {
  while (!principal.waiting.empty() && principal.confirmed + principal.on_trial < kTrial) {
    const Principal::Waiting one =
        std::move(principal.waiting.extract(principal.waiting.begin()).mapped());
    const TaskRecord* record = leases_.find(one.result.key);
    // Somebody else was faster: it is compared when it is sent again.
    if (record == nullptr) continue;
    ++principal.on_trial;
    cases_.open(record->task,
                Said{.what = Said::What::Score,
                     .worker = one.worker,
                     .principal = principal.name,
                     .score = one.result.score,
                     .state_digest = one.result.state_digest,
                     .wall_us = one.result.wall_us,
                     .time = one.result.time,
                     .attempt = one.result.attempt,
                     .on_trial = true},
                false);
  }
  if (principal.confirmed >= kTrial) take_waiting(principal, now);
}

/// It is known now: what waited counts.
void Scheduler::take_waiting(Principal& principal, TimePoint now) {
  for (const auto& [key, one] : std::exchange(principal.waiting, {})) {
    TaskRecord* record = leases_.find(key);
    WorkerEntry* entry = workers_.of_number(one.worker);
    if (record == nullptr) continue;
    if (entry != nullptr) {
      take(*entry, *record, one.result, now);
    } else {
      leases_.unpark(*record);
    }
  }
  update_room(principal);
}

/// A later process draws the same.
bool Scheduler::is_drawn(PackedKey key, double share) const {
  return static_cast<double>(signer_.draw(key)) < share * 0x1p64;
}

void Scheduler::audit(const TaskRecord& record, const WorkerEntry& entry, const Result& result) {
  const std::int64_t every = policy_of(record).audit_every;
  if (every == 0 || options_.evaluates_programs || result.rejected) return;
  const bool has_word = cases_.knows(result.key);
  const double backlog_us = referee_us_ * static_cast<double>(cases_.size());
  if (!has_word && cases_.audits() > 0 && backlog_us > kMostBacklogUs) return;
  const Principal& principal = *entry.principal;
  const double dense =
      principal.local ? 0 : kDenseAtFirst / static_cast<double>(principal.taken + 1);
  const double share = std::max(1.0 / static_cast<double>(every), dense);
  if (!has_word && !is_drawn(result.key, share)) return;
  cases_.open(record.task,
              Said{.what = Said::What::Score,
                   .worker = entry.number,
                   .principal = entry.principal->name,
                   .score = result.score,
                   .state_digest = result.state_digest,
                   .taken = true},
              true);
}

// --- strikes and quarantine ---

void Scheduler::update_room(Principal& principal) {
  for (const WorkerNumber number : principal.workers) {
    WorkerEntry& entry = *workers_.of_number(number);
    set_credit(entry, entry.credit);
  }
}

void Scheduler::go_astray(Principal& principal, std::size_t leases, TimePoint now) {
  if (leases == 0 || is_proven(principal)) return;
  principal.astray += static_cast<std::int64_t>(leases);
  if (principal.astray < kMostAstray || proven_present() == 0) return;
  principal.waits_until =
      now + std::chrono::seconds(std::min(principal.astray, kMostSecondsToWait));
  update_room(principal);
}

void Scheduler::set_credit(WorkerEntry& entry, std::uint32_t credit) {
  entry.credit = std::min(credit, options_.max_credit);
  entry.asked |= credit > 0;
  const Principal& principal = *entry.principal;
  std::size_t most = entry.credit;
  if (principal.claims >= Principal::kMostClaims) most = 0;
  const bool is_new = !options_.evaluates_programs && !is_proven(principal);
  if (is_new) most = std::min(most, latest_ < principal.waits_until ? 0 : kRoomOnTrial);
  const auto slots = static_cast<std::size_t>(entry.usable() ? entry.hello.slots : 0);
  leases_.loads().set_capacity(entry.number, slots, slots > 0 ? most : 0);
}

void Scheduler::strike(Principal& principal, TimePoint now) {
  if (options_.quarantine_after == 0) return;
  ++principal.strikes;
  const std::int64_t tried = principal.taken + principal.strikes;
  const bool often =
      principal.strikes >= options_.quarantine_after && principal.strikes * kOneOf >= tried;
  if (often) quarantine(principal, "fails at evaluations that succeed elsewhere", now);
}

/// Its word is wrong. What it said before and nobody made again cannot be believed either.
void Scheduler::convict(Principal& principal, const std::string& evidence, TimePoint now) {
  if (principal.quarantined) return;
  quarantine(principal, evidence, now);
  for (std::uint32_t campaign = 0; campaign < principal.unchecked.size(); ++campaign) {
    const std::int64_t unchecked = principal.unchecked[campaign];
    if (unchecked == 0 || stopped_.contains(campaign)) continue;
    stop(campaign,
         "scores in the store are not to be believed: " + evidence + ", and " +
             std::to_string(unchecked) + " results of " + principal.name +
             " are stored that nobody made again. Run the campaign again into a new store, without "
             "the workers of " +
             principal.name,
         true);
  }
}

void Scheduler::quarantine(Principal& principal, const std::string& reason, TimePoint now) {
  if (principal.quarantined) return;
  principal.quarantined = true;
  ++counters_.quarantined;
  note("error", "workers in quarantine",
       {{"who", principal.name},
        {"reason", reason},
        {"results in the store", principal.taken},
        {"made again", principal.confirmed}});
  for (const WorkerNumber number : principal.workers) {
    WorkerEntry& entry = *workers_.of_number(number);
    const std::list<PackedKey>& leases = leases_.leases_of(number);
    const std::vector<PackedKey> keys(leases.rbegin(), leases.rend());
    for (const PackedKey key : keys) {
      TaskRecord& record = *leases_.find(key);
      note_attempt(record, number, AttemptOutcome::Returned, now);
      if (leases_.requeue(record, number)) ++counters_.requeued;
    }
    workers_.quarantine(entry);
    set_credit(entry, 0);
    actions_.emplace_back(WorkerChanged{row_of(entry, WorkerState::Quarantined)});
  }
  // What it said, and was not taken yet, is as if it had not been said.
  for (const auto& [key, one] : std::exchange(principal.waiting, {})) {
    TaskRecord* record = leases_.find(key);
    if (record != nullptr && !cases_.knows(key)) leases_.unpark(*record);
  }
  if (workers_.trusted() == 0) note("error", "no worker left that is trusted", {});
}

}  // namespace swarmsmith
