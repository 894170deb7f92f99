// How the scheduler assigns tasks, and how it reacts to the passing of time.

#include <algorithm>
#include <map>

#include "base/assert.h"
#include "coordinator/pool/scheduler.h"
#include "proto/wire.h"

namespace swarmsmith {
namespace {

constexpr Duration kForgetEvery = std::chrono::minutes(1);
constexpr int kResendsOfAProgram = 3;
/// Programs that take less time than this get one task in advance for each slot.
constexpr double kShortProgramUs = 20'000;
/// The size of a task on the network without its machine.
constexpr std::size_t kTaskBytes = 57;
constexpr std::size_t kAliveBytes = 8;

/// Calls `what` for each worker of a set, beginning after `last` and going round once, until it
/// returns false. The set may change meanwhile.
template <class What>
void in_turn(const std::set<WorkerNumber>& workers, WorkerNumber last, const What& what) {
  for (auto at = workers.upper_bound(last); at != workers.end();) {
    const WorkerNumber worker = *at;
    if (!what(worker)) return;
    at = workers.upper_bound(worker);
  }
  for (auto at = workers.begin(); at != workers.end() && *at <= last;) {
    const WorkerNumber worker = *at;
    if (!what(worker)) return;
    at = workers.upper_bound(worker);
  }
}

}  // namespace

void Scheduler::on_tick(TimePoint now) {
  book_->now = now;
  if (ticked_ != TimePoint{} && now - ticked_ > book_->options.dead_after / 2) pardon(now);
  ticked_ = now;
  for (auto& [number, entry] : workers_->all()) {
    if (!entry.connected) continue;
    if (now - entry.last_heard > book_->options.dead_after) {
      lost_.lose(entry, Loss::Silence, WorkerState::Lost, now);
      continue;
    }
    if (now - entry.last_sent >= book_->options.heartbeat) {
      book_->act(SendHeartbeat{entry.peer, entry.hello.incarnation});
      entry.last_sent = now;
    }
    expire(entry, now);
  }
  if (now - forgot_ > kForgetEvery || workers_->has_many_gone()) {
    workers_->forget_old(now);
    trust_->forget_idle();
    forgot_ = now;
  }
}

/// This process was stopped or got no processor time, so it could not receive messages, and its
/// measurement of silence is wrong (orchestration facts, 5 "Heartbeats, both ways").
void Scheduler::pardon(TimePoint now) {
  for (auto& [number, entry] : workers_->all()) {
    if (!entry.connected) continue;
    entry.last_heard = now;
    for (const PackedKey key : book_->leases.leases_of(number))
      book_->leases.find(key)->lease_of(number)->renewed = now;
  }
}

/// Workers hold few tasks besides those that they run, so a task that is neither done nor running
/// by now never arrived, or its result was lost (orchestration facts, 5 "Leases"). The worker
/// itself is alive: it does not count as lost, and keeps its other leases.
void Scheduler::expire(WorkerEntry& entry, TimePoint now) {
  // A program must not run a second time while the first run may still be active. If the worker has
  // a free slot, each of its tasks is either running or never arrived, and a lost result has been
  // sent again by now.
  if (book_->options.evaluates_programs &&
      entry.running >= static_cast<std::size_t>(entry.hello.slots)) {
    return;
  }
  const Duration least = book_->options.evaluates_programs
                             ? kResendsOfAProgram * book_->options.resend
                             : book_->options.lease_floor;
  Duration longest = least;
  std::vector<PackedKey> late;
  for (const PackedKey key : book_->leases.leases_of(entry.number)) {
    const Lease& lease = *book_->leases.find(key)->lease_of(entry.number);
    if (now - lease.granted <= least) break;
    const Duration time = book_->options.evaluates_programs ? least : lease_time(campaign_of(key));
    longest = std::max(longest, time);
    if (now - lease.renewed > time) late.push_back(key);
  }
  for (auto key = late.rbegin(); key != late.rend(); ++key) {
    TaskRecord& record = *book_->leases.find(*key);
    if (record.second) record.copied = false;
    book_->note_attempt(record, entry.number, AttemptOutcome::Expired, now);
    ++book_->counters.expired;
    if (book_->leases.requeue(record, entry.number)) ++book_->counters.requeued;
  }
  trust_->go_astray(*entry.principal, late.size(), now);
  book_->leases.loads().settle_older(entry.number, now - longest);
}

void Scheduler::drain(TimePoint now) {
  draining_ = true;
  for (auto& [number, entry] : workers_->all()) {
    if (!entry.connected) continue;
    book_->act(SendDrain{entry.peer, entry.hello.incarnation});
    entry.last_sent = now;
  }
}

/// In the order of importance: tasks that a race waits for; second copies of those that have been
/// running longest; look-ahead.
void Scheduler::dispatch(TimePoint now) {
  book_->now = now;
  if (held_ || draining_) return;
  trust_->ask_referee();
  if (workers_->trusted() == 0) return;
  dispatch_alone(now);
  dispatch_wanted(now);
  if (book_->leases.wanted_ready() > 0 || book_->options.evaluates_programs) return;
  copy_stragglers(now);
  dispatch_ahead(now);
}

void Scheduler::dispatch_wanted(TimePoint now) {
  if (book_->leases.wanted_ready() == 0) return;
  // Guided self-scheduling (orchestration facts, 5 "Credit"): near the end of the work, no worker
  // holds more than half of its share, because otherwise a step would wait for one worker's queue.
  // A single worker may have all tasks, because its slots share them.
  const auto remaining =
      static_cast<std::int64_t>(book_->leases.wanted_ready() + book_->leases.wanted_leased());
  SWARMSMITH_ASSERT(workers_->slots() > 0, "a worker that is trusted has a slot");
  const std::int64_t parts = workers_->trusted() > 1 ? 2 * workers_->slots() : workers_->slots();
  const std::int64_t share = std::max<std::int64_t>(1, (remaining + parts - 1) / parts);
  in_turn(book_->leases.loads().with_room(), turn_,
          [&](WorkerNumber number) { return fill(*workers_->of_number(number), share, now); });
}

/// Reserves workers for tasks that may have killed a worker, at most half of the workers at a time:
/// a campaign in which every task kills workers must not stop all other campaigns.
void Scheduler::dispatch_alone(TimePoint now) {
  if (!book_->leases.has_alone()) return;
  // The death of a stranger's worker would prove nothing.
  const bool only_proven = trust_->proven_present() > 0;
  std::size_t reserved = 0;
  for (auto& [number, entry] : workers_->all()) {
    if (only_proven && !entry.principal->is_proven()) entry.reserved = false;
    if (entry.connected && entry.reserved) ++reserved;
  }
  const std::size_t limit = std::max<std::size_t>(1, workers_->trusted() / 2);
  for (auto& [number, entry] : workers_->all()) {
    if (!book_->leases.has_alone()) return;
    if (!entry.usable() || book_->leases.loads().of(number).credit == 0) continue;
    if (only_proven && !entry.principal->is_proven()) continue;
    if (!entry.reserved && reserved >= limit) continue;
    if (!entry.reserved) ++reserved;
    entry.reserved = true;
    if (!book_->leases.leases_of(number).empty()) continue;
    TaskRecord* record = book_->leases.next_alone();
    SWARMSMITH_ASSERT(record != nullptr, "a worker is kept free only for an existing task");
    book_->leases.grant(*record, number, now, cost_us(record->task.campaign));
    SendTasks message{entry.peer, entry.hello.incarnation, {}};
    put_task(entry, *record, message, now);
    send_tasks(entry, message, now);
  }
}

/// The number of tasks that a worker may hold. A program may take hours, and tasks that wait behind
/// it lose time: so a worker holds only the tasks that it runs, and one more for each slot if
/// programs are short.
std::int64_t Scheduler::most_for(const WorkerEntry& entry, std::int64_t share) const {
  const std::int64_t wanted = std::min<std::int64_t>(entry.credit, share * entry.hello.slots);
  if (!book_->options.evaluates_programs) return wanted;
  const bool short_ones = book_->estimate_us > 0 && book_->estimate_us < kShortProgramUs;
  return std::min<std::int64_t>(wanted, std::int64_t{short_ones ? 2 : 1} * entry.hello.slots);
}

/// Whether the worker is kept free for a task that must run alone; ends when there is no such task.
bool Scheduler::is_kept_free(WorkerEntry& entry) {
  if (!entry.reserved) return false;
  const std::list<PackedKey>& leases = book_->leases.leases_of(entry.number);
  const bool runs_alone = !leases.empty() && book_->leases.find(leases.front())->lease->alone;
  entry.reserved = book_->leases.has_alone() || runs_alone;
  return entry.reserved;
}

/// Returns false if there is nothing left to lease.
bool Scheduler::fill(WorkerEntry& entry, std::int64_t share, TimePoint now) {
  if (is_kept_free(entry)) return true;
  // Look-ahead does not count here, so that it does not keep urgent tasks away.
  const WorkerLoad& load = book_->leases.loads().of(entry.number);
  const auto room_of = [&] {
    return std::min(static_cast<std::int64_t>(load.room()),
                    most_for(entry, share) - static_cast<std::int64_t>(load.held() - load.ahead));
  };
  const bool elsewhere = workers_->trusted() > 1;
  // The work of the whole pool during one evaluation.
  const auto allowance_us =
      static_cast<std::uint64_t>(book_->estimate_us * static_cast<double>(workers_->slots()));
  SendTasks message{entry.peer, entry.hello.incarnation, {}};
  for (std::int64_t room = room_of(); room > 0; --room) {
    TaskRecord* record =
        book_->leases.next(entry.number, elsewhere, book_->leases.loads().room(), allowance_us);
    if (record == nullptr) break;
    book_->leases.grant(*record, entry.number, now, cost_us(record->task.campaign));
    put_task(entry, *record, message, now);
  }
  if (message.tasks.empty()) return true;
  send_tasks(entry, message, now);
  turn_ = entry.number;
  return book_->leases.wanted_ready() > 0;
}

/// Adds a task to the message, and sends the message when it is full.
void Scheduler::put_task(WorkerEntry& entry, const TaskRecord& record, SendTasks& message,
                         TimePoint now) {
  SWARMSMITH_ASSERT(entry.usable(), "leases go only to connected, trusted workers");
  const Lease& lease =
      record.second && record.second->worker == entry.number ? *record.second : *record.lease;
  message.tasks.push_back({record.task, key_of(record.task), lease.attempt,
                           trust_->signer().sign(record.task, lease.attempt, entry.principal->name),
                           lease.alone});
  message.bytes += record.task.machine.size() + kAliveBytes * record.task.alive.size() + kTaskBytes;
  const bool full =
      message.tasks.size() >= kTasksPerMessage || message.bytes >= kTaskBytesPerMessage;
  if (full) send_tasks(entry, message, now);
}

void Scheduler::send_tasks(WorkerEntry& entry, SendTasks& message, TimePoint now) {
  entry.last_sent = now;
  book_->act(std::move(message));
  message = SendTasks{entry.peer, entry.hello.incarnation, {}};
}

Duration Scheduler::copy_time(std::uint32_t campaign) const {
  const auto estimate =
      std::chrono::microseconds(static_cast<std::int64_t>(book_->estimate_us_of(campaign)));
  return std::max<Duration>(book_->options.copy_floor, book_->options.copy_factor * estimate);
}

/// Leases the oldest tasks that have been out suspiciously long once more, so that one slow,
/// stopped or disconnected worker does not delay a step. The first result is accepted
/// (orchestration facts, 5 "Stragglers").
void Scheduler::copy_stragglers(TimePoint now) {
  if (book_->leases.loads().with_idle().empty() || book_->leases.leased() == 0) return;
  Duration least = copy_time(0);
  for (std::uint32_t campaign = 1; campaign < book_->options.campaigns.size(); ++campaign)
    least = std::min(least, copy_time(campaign));
  std::map<WorkerNumber, SendTasks> messages;
  for (const PackedKey key : book_->leases.by_age()) {
    TaskRecord& record = *book_->leases.find(key);
    const Duration out = now - record.lease->granted;
    if (out <= least || book_->leases.loads().with_idle().empty()) break;
    if (record.second || record.copied || record.alone || record.task.ahead) continue;
    if (record.design->held || out <= copy_time(record.task.campaign)) continue;
    WorkerEntry* entry = idle_for(record);
    if (entry == nullptr) continue;
    book_->leases.copy(record, entry->number, now);
    ++book_->counters.copies;
    const auto message =
        messages.try_emplace(entry->number, SendTasks{entry->peer, entry->hello.incarnation, {}})
            .first;
    put_task(*entry, record, message->second, now);
    turn_ = entry->number;
  }
  for (auto& [number, message] : messages) {
    if (!message.tasks.empty()) send_tasks(*workers_->of_number(number), message, now);
  }
}

/// A worker with an idle slot that does not have the task; null if there is none.
WorkerEntry* Scheduler::idle_for(const TaskRecord& record) {
  WorkerEntry* found = nullptr;
  in_turn(book_->leases.loads().with_idle(), turn_, [&](WorkerNumber number) {
    WorkerEntry& entry = *workers_->of_number(number);
    const bool fits = number != record.lease->worker && number != record.avoid;
    if (fits && !is_kept_free(entry)) found = &entry;
    return found == nullptr;
  });
  return found;
}

std::size_t Scheduler::idle_slots() const {
  if (held_ || draining_ || book_->options.evaluates_programs || book_->leases.wanted_ready() > 0)
    return 0;
  const std::size_t idle = book_->leases.loads().idle();
  return idle - std::min(idle, book_->leases.ahead_ready());
}

void Scheduler::dispatch_ahead(TimePoint now) {
  if (book_->leases.ahead_ready() == 0) return;
  in_turn(book_->leases.loads().with_idle(), turn_,
          [&](WorkerNumber number) { return fill_ahead(*workers_->of_number(number), now); });
}

/// Leases look-ahead only to slots that would idle, so that wanted tasks never wait behind it.
/// Returns false if there is no look-ahead left
/// (orchestration facts, 10 "Look-ahead").
bool Scheduler::fill_ahead(WorkerEntry& entry, TimePoint now) {
  if (is_kept_free(entry)) return true;
  const bool elsewhere = workers_->trusted() > 1;
  SendTasks message{entry.peer, entry.hello.incarnation, {}};
  for (std::size_t room = book_->leases.loads().of(entry.number).idle(); room > 0; --room) {
    TaskRecord* record = book_->leases.next_ahead(entry.number, elsewhere);
    if (record == nullptr) break;
    book_->leases.grant(*record, entry.number, now);
    ++book_->counters.ahead;
    put_task(entry, *record, message, now);
  }
  if (message.tasks.empty()) return book_->leases.ahead_ready() > 0;
  send_tasks(entry, message, now);
  turn_ = entry.number;
  return book_->leases.ahead_ready() > 0;
}

std::uint64_t Scheduler::cost_us(std::uint32_t campaign) const {
  return static_cast<std::uint64_t>(std::max(1.0, book_->estimate_us_of(campaign)));
}

Duration Scheduler::lease_time(std::uint32_t campaign) const {
  const auto estimate =
      std::chrono::microseconds(static_cast<std::int64_t>(book_->estimate_us_of(campaign)));
  return std::max<Duration>(book_->options.lease_floor, book_->options.lease_factor * estimate);
}

}  // namespace swarmsmith
