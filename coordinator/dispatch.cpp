// The scheduler's other half: who gets what, and what the passing of time does.

#include <algorithm>

#include "coordinator/scheduler.h"
#include "proto/wire.h"

namespace swarmsmith {
namespace {

constexpr Duration kForgetEvery = std::chrono::minutes(1);
constexpr int kResendsOfAProgram = 3;
/// Programs that take less are leased one ahead for each slot.
constexpr double kShortProgramUs = 20'000;
/// What a task takes on the wire besides its machine.
constexpr std::size_t kTaskBytes = 48;

}  // namespace

Duration Scheduler::lease_time() const {
  const auto estimate = std::chrono::microseconds(static_cast<std::int64_t>(estimate_us_));
  return std::max<Duration>(options_.lease_floor, options_.lease_factor * estimate);
}

void Scheduler::on_tick(TimePoint now) {
  latest_ = now;
  if (ticked_ != TimePoint{} && now - ticked_ > options_.dead_after / 2) pardon(now);
  ticked_ = now;
  for (auto& [number, entry] : workers_.all()) {
    if (!entry.connected) continue;
    if (now - entry.last_heard > options_.dead_after) {
      lose(entry, Loss::Silence, "lost", now);
      continue;
    }
    if (now - entry.last_sent >= options_.heartbeat) {
      actions_.emplace_back(SendHeartbeat{entry.peer, entry.hello.incarnation});
      entry.last_sent = now;
    }
    expire(entry, now);
  }
  if (now - forgot_ > kForgetEvery) {
    workers_.forget_old(now);
    forgot_ = now;
  }
}

/// This process was stopped or starved, so that it is no wonder that nobody was heard.
void Scheduler::pardon(TimePoint now) {
  for (auto& [number, entry] : workers_.all()) {
    if (!entry.connected) continue;
    entry.last_heard = now;
    for (const PackedKey key : leases_.leases_of(number))
      leases_.find(key)->lease->renewed = now;
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
  const Duration time =
      options_.evaluates_programs ? kResendsOfAProgram * options_.resend : lease_time();
  std::vector<PackedKey> late;
  for (const PackedKey key : leases_.leases_of(entry.number)) {
    const Lease& lease = *leases_.find(key)->lease;
    if (now - lease.granted <= time) break;
    if (now - lease.renewed > time) late.push_back(key);
  }
  for (auto key = late.rbegin(); key != late.rend(); ++key) {
    TaskRecord& record = *leases_.find(*key);
    note_attempt(record, "expired", now);
    take_back(record);
    ++counters_.expired;
    ++counters_.requeued;
  }
}

void Scheduler::drain(TimePoint now) {
  draining_ = true;
  for (auto& [number, entry] : workers_.all()) {
    if (!entry.connected) continue;
    actions_.emplace_back(SendDrain{entry.peer, entry.hello.incarnation});
    entry.last_sent = now;
  }
}

void Scheduler::dispatch(TimePoint now) {
  latest_ = now;
  if (held_ || draining_ || workers_.trusted() == 0) return;
  dispatch_alone(now);
  dispatch_audits(now);
  if (leases_.queued() == 0) return;
  // Guided self-scheduling: near the end of what there is, nobody holds more than half a share of
  // it. A worker that is alone may have it all: its slots share what it holds.
  const auto remaining = static_cast<std::int64_t>(leases_.size());
  const std::int64_t parts = workers_.trusted() > 1 ? 2 * workers_.slots() : workers_.slots();
  const std::int64_t share = std::max<std::int64_t>(1, (remaining + parts - 1) / parts);
  auto& all = workers_.all();
  const auto first = all.upper_bound(turn_);
  for (auto at = first; at != all.end(); ++at) {
    if (at->second.usable() && !fill(at->second, share, now)) return;
  }
  for (auto at = all.begin(); at != first; ++at) {
    if (at->second.usable() && !fill(at->second, share, now)) return;
  }
}

/// Reserves workers for tasks that may have killed one, at most half of them at a time.
void Scheduler::dispatch_alone(TimePoint now) {
  std::size_t reserved = 0;
  if (!leases_.has_alone()) return;
  for (auto& [number, entry] : workers_.all()) {
    if (entry.connected && entry.reserved) ++reserved;
  }
  const std::size_t limit = std::max<std::size_t>(1, workers_.trusted() / 2);
  for (auto& [number, entry] : workers_.all()) {
    if (!leases_.has_alone()) return;
    if (!entry.usable() || entry.credit == 0) continue;
    if (!entry.reserved && reserved >= limit) continue;
    if (!entry.reserved) ++reserved;
    entry.reserved = true;
    if (!leases_.leases_of(number).empty()) continue;
    TaskRecord* record = leases_.next_alone();
    leases_.grant(*record, number, now);
    SendTasks message{entry.peer, entry.hello.incarnation, {}};
    message.tasks.push_back({record->task, record->lease->attempt});
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

/// False when nothing is left that could be leased.
bool Scheduler::fill(WorkerEntry& entry, std::int64_t share, TimePoint now) {
  if (entry.reserved) {
    const std::list<PackedKey>& leases = leases_.leases_of(entry.number);
    const bool runs_alone = !leases.empty() && leases_.find(leases.front())->lease->alone;
    const bool waits_for_alone = leases_.has_alone() || runs_alone;
    if (waits_for_alone) return true;
    entry.reserved = false;
  }
  const auto held = static_cast<std::int64_t>(leases_.leases_of(entry.number).size());
  std::int64_t room = most_for(entry, share) - held;
  if (room <= 0) return true;
  const bool elsewhere = workers_.trusted() > 1;
  SendTasks message{entry.peer, entry.hello.incarnation, {}};
  std::size_t bytes = 0;
  TaskRecord* record = nullptr;
  while (room > 0 && (record = leases_.next(entry.number, elsewhere)) != nullptr) {
    leases_.grant(*record, entry.number, now);
    message.tasks.push_back({record->task, record->lease->attempt});
    bytes += record->task.machine.size() + kTaskBytes;
    --room;
    if (message.tasks.size() >= kTasksPerMessage || bytes >= kTaskBytesPerMessage) {
      send_tasks(entry, message, now);
      message.tasks.clear();
      bytes = 0;
    }
  }
  if (!message.tasks.empty()) send_tasks(entry, message, now);
  turn_ = entry.number;
  return leases_.queued() > 0;
}

void Scheduler::send_tasks(WorkerEntry& entry, SendTasks& message, TimePoint now) {
  entry.last_sent = now;
  actions_.emplace_back(std::move(message));
  message = SendTasks{entry.peer, entry.hello.incarnation, {}};
}

}  // namespace swarmsmith
