// Who gets what from the scheduler, and what the passing of time does.

#include <algorithm>

#include "coordinator/pool/in_turn.h"
#include "coordinator/pool/scheduler.h"
#include "proto/wire.h"

namespace swarmsmith {
namespace {

constexpr Duration kForgetEvery = std::chrono::minutes(1);
constexpr int kResendsOfAProgram = 3;
/// Programs that take less are leased one ahead for each slot.
constexpr double kShortProgramUs = 20'000;
/// What a task takes on the wire besides its machine.
constexpr std::size_t kTaskBytes = 57;
constexpr std::size_t kAliveBytes = 8;

}  // namespace

double Scheduler::estimate_us(std::uint32_t campaign) const {
  const double own = estimates_us_[campaign];
  return own > 0 ? own : estimate_us_;
}

void Scheduler::learn(std::uint32_t campaign, std::int64_t wall_us) {
  const auto spent_us = static_cast<double>(std::max<std::int64_t>(wall_us, 0));
  for (double* estimate : {&estimate_us_, &estimates_us_[campaign]})
    *estimate += (*estimate == 0 ? 1.0 : 0.05) * (spent_us - *estimate);
}

std::uint64_t Scheduler::cost_us(std::uint32_t campaign) const {
  return static_cast<std::uint64_t>(std::max(1.0, estimate_us(campaign)));
}

Duration Scheduler::lease_time(std::uint32_t campaign) const {
  const auto estimate = std::chrono::microseconds(static_cast<std::int64_t>(estimate_us(campaign)));
  return std::max<Duration>(options_.lease_floor, options_.lease_factor * estimate);
}

void Scheduler::on_tick(TimePoint now) {
  latest_ = now;
  if (ticked_ != TimePoint{} && now - ticked_ > options_.dead_after / 2) pardon(now);
  ticked_ = now;
  for (auto& [number, entry] : workers_.all()) {
    if (!entry.connected) continue;
    if (now - entry.last_heard > options_.dead_after) {
      lose(entry, Loss::Silence, WorkerState::Lost, now);
      continue;
    }
    if (now - entry.last_sent >= options_.heartbeat) {
      actions_.emplace_back(SendHeartbeat{entry.peer, entry.hello.incarnation});
      entry.last_sent = now;
    }
    expire(entry, now);
  }
  if (now - forgot_ > kForgetEvery || workers_.has_many_gone()) {
    workers_.forget_old(now);
    principals_.forget_idle();
    forgot_ = now;
  }
}

/// This process was stopped or starved, so that it is no wonder that nobody was heard.
void Scheduler::pardon(TimePoint now) {
  for (auto& [number, entry] : workers_.all()) {
    if (!entry.connected) continue;
    entry.last_heard = now;
    for (const PackedKey key : leases_.leases_of(number))
      leases_.find(key)->lease_of(number)->renewed = now;
  }
}

/// Workers hold little more than they run, so a task that is neither done nor running by now never
/// arrived, or its result did not.
void Scheduler::expire(WorkerEntry& entry, TimePoint now) {
  // A program is not run a second time while it may run. With a slot free, what the worker was
  // given either runs or never came, and a result that went astray was sent again by now.
  if (options_.evaluates_programs && entry.running >= static_cast<std::size_t>(entry.hello.slots)) {
    return;
  }
  const Duration least =
      options_.evaluates_programs ? kResendsOfAProgram * options_.resend : options_.lease_floor;
  Duration longest = least;
  std::vector<PackedKey> late;
  for (const PackedKey key : leases_.leases_of(entry.number)) {
    const Lease& lease = *leases_.find(key)->lease_of(entry.number);
    if (now - lease.granted <= least) break;
    const Duration time = options_.evaluates_programs ? least : lease_time(campaign_of(key));
    longest = std::max(longest, time);
    if (now - lease.renewed > time) late.push_back(key);
  }
  for (auto key = late.rbegin(); key != late.rend(); ++key) {
    TaskRecord& record = *leases_.find(*key);
    if (record.second) record.copied = false;
    note_attempt(record, entry.number, AttemptOutcome::Expired, now);
    ++counters_.expired;
    if (leases_.requeue(record, entry.number)) ++counters_.requeued;
  }
  go_astray(*entry.principal, late.size(), now);
  leases_.loads().settle_older(entry.number, now - longest);
}

void Scheduler::drain(TimePoint now) {
  draining_ = true;
  for (auto& [number, entry] : workers_.all()) {
    if (!entry.connected) continue;
    actions_.emplace_back(SendDrain{entry.peer, entry.hello.incarnation});
    entry.last_sent = now;
  }
}

/// In the order of their worth: what a race waits for; a second try at what it waits for longest;
/// what it may want later.
void Scheduler::dispatch(TimePoint now) {
  latest_ = now;
  if (held_ || draining_) return;
  ask_referee();
  if (workers_.trusted() == 0) return;
  dispatch_alone(now);
  dispatch_wanted(now);
  if (leases_.wanted_ready() > 0 || options_.evaluates_programs) return;
  copy_stragglers(now);
  dispatch_ahead(now);
}

void Scheduler::dispatch_wanted(TimePoint now) {
  if (leases_.wanted_ready() == 0) return;
  // Guided self-scheduling: near the end of what there is, nobody holds more than half a share of
  // it. A worker that is alone may have it all: its slots share what it holds.
  const auto remaining =
      static_cast<std::int64_t>(leases_.wanted_ready() + leases_.wanted_leased());
  const std::int64_t parts = workers_.trusted() > 1 ? 2 * workers_.slots() : workers_.slots();
  const std::int64_t share = std::max<std::int64_t>(1, (remaining + parts - 1) / parts);
  in_turn(leases_.loads().with_room(), turn_,
          [&](WorkerNumber number) { return fill(*workers_.of_number(number), share, now); });
}

/// Reserves workers for tasks that may have killed one, at most half of them at a time.
void Scheduler::dispatch_alone(TimePoint now) {
  if (!leases_.has_alone()) return;
  // A stranger's death would say nothing.
  const bool only_proven = proven_present() > 0;
  std::size_t reserved = 0;
  for (auto& [number, entry] : workers_.all()) {
    if (only_proven && !is_proven(*entry.principal)) entry.reserved = false;
    if (entry.connected && entry.reserved) ++reserved;
  }
  const std::size_t limit = std::max<std::size_t>(1, workers_.trusted() / 2);
  for (auto& [number, entry] : workers_.all()) {
    if (!leases_.has_alone()) return;
    if (!entry.usable() || leases_.loads().of(number).credit == 0) continue;
    if (only_proven && !is_proven(*entry.principal)) continue;
    if (!entry.reserved && reserved >= limit) continue;
    if (!entry.reserved) ++reserved;
    entry.reserved = true;
    if (!leases_.leases_of(number).empty()) continue;
    TaskRecord* record = leases_.next_alone();
    leases_.grant(*record, number, now, cost_us(record->task.campaign));
    SendTasks message{entry.peer, entry.hello.incarnation, {}};
    put_task(entry, *record, message, now);
    send_tasks(entry, message, now);
  }
}

/// What a worker may hold. A program may take hours, and what waits behind it is lost time: a
/// worker holds what it runs, and one more for each slot when that is soon done.
std::int64_t Scheduler::most_for(const WorkerEntry& entry, std::int64_t share) const {
  const std::int64_t wanted = std::min<std::int64_t>(entry.credit, share * entry.hello.slots);
  if (!options_.evaluates_programs) return wanted;
  const bool short_ones = estimate_us_ > 0 && estimate_us_ < kShortProgramUs;
  return std::min<std::int64_t>(wanted, std::int64_t{short_ones ? 2 : 1} * entry.hello.slots);
}

/// For a task that must have it alone; until there is none any more.
bool Scheduler::is_kept_free(WorkerEntry& entry) {
  if (!entry.reserved) return false;
  const std::list<PackedKey>& leases = leases_.leases_of(entry.number);
  const bool runs_alone = !leases.empty() && leases_.find(leases.front())->lease->alone;
  entry.reserved = leases_.has_alone() || runs_alone;
  return entry.reserved;
}

/// False when nothing is left that could be leased.
bool Scheduler::fill(WorkerEntry& entry, std::int64_t share, TimePoint now) {
  if (is_kept_free(entry)) return true;
  // Look-ahead leaves when it is done, and does not keep urgent tasks away.
  const WorkerLoad& load = leases_.loads().of(entry.number);
  const auto room_of = [&] {
    return std::min(static_cast<std::int64_t>(load.room()),
                    most_for(entry, share) - static_cast<std::int64_t>(load.held() - load.ahead));
  };
  const bool elsewhere = workers_.trusted() > 1;
  // What the whole pool does in the time of one evaluation.
  const auto allowance_us =
      static_cast<std::uint64_t>(estimate_us_ * static_cast<double>(workers_.slots()));
  SendTasks message{entry.peer, entry.hello.incarnation, {}};
  for (std::int64_t room = room_of(); room > 0; --room) {
    TaskRecord* record =
        leases_.next(entry.number, elsewhere, leases_.loads().room(), allowance_us);
    if (record == nullptr) break;
    leases_.grant(*record, entry.number, now, cost_us(record->task.campaign));
    put_task(entry, *record, message, now);
  }
  if (message.tasks.empty()) return true;
  send_tasks(entry, message, now);
  turn_ = entry.number;
  return leases_.wanted_ready() > 0;
}

/// Sends what there is when a message is full.
void Scheduler::put_task(WorkerEntry& entry, const TaskRecord& record, SendTasks& message,
                         TimePoint now) {
  const Lease& lease =
      record.second && record.second->worker == entry.number ? *record.second : *record.lease;
  message.tasks.push_back({record.task, key_of(record.task), lease.attempt,
                           signer_.sign(record.task, lease.attempt, entry.principal->name),
                           lease.alone});
  message.bytes += record.task.machine.size() + kAliveBytes * record.task.alive.size() + kTaskBytes;
  const bool full =
      message.tasks.size() >= kTasksPerMessage || message.bytes >= kTaskBytesPerMessage;
  if (full) send_tasks(entry, message, now);
}

void Scheduler::send_tasks(WorkerEntry& entry, SendTasks& message, TimePoint now) {
  entry.last_sent = now;
  actions_.emplace_back(std::move(message));
  message = SendTasks{entry.peer, entry.hello.incarnation, {}};
}

}  // namespace swarmsmith
