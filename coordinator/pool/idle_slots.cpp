// The scheduler's part for slots that would idle: second copies of stragglers, then look-ahead
// (orchestration facts, 5 "Stragglers" and 10). Not for programs, whose calls are kept few.

#include <algorithm>
#include <map>

#include "coordinator/pool/in_turn.h"
#include "coordinator/pool/scheduler.h"

namespace swarmsmith {

Duration Scheduler::copy_time(std::uint32_t campaign) const {
  const auto estimate = std::chrono::microseconds(static_cast<std::int64_t>(estimate_us(campaign)));
  return std::max<Duration>(options_.copy_floor, options_.copy_factor * estimate);
}

/// The oldest tasks that are out for suspiciously long, once more each: one slow, stopped or cut
/// off worker does not hold up a step. Whichever result comes first is taken.
void Scheduler::copy_stragglers(TimePoint now) {
  if (leases_.loads().with_idle().empty() || leases_.leased() == 0) return;
  Duration least = copy_time(0);
  for (std::uint32_t campaign = 1; campaign < options_.campaigns.size(); ++campaign)
    least = std::min(least, copy_time(campaign));
  std::map<WorkerNumber, SendTasks> messages;
  for (const PackedKey key : leases_.by_age()) {
    TaskRecord& record = *leases_.find(key);
    const Duration out = now - record.lease->granted;
    if (out <= least || leases_.loads().with_idle().empty()) break;
    if (record.second || record.copied || record.alone || record.task.ahead) continue;
    if (record.design->held || out <= copy_time(record.task.campaign)) continue;
    WorkerEntry* entry = idle_for(record);
    if (entry == nullptr) continue;
    leases_.copy(record, entry->number, now);
    ++counters_.copies;
    const auto message =
        messages.try_emplace(entry->number, SendTasks{entry->peer, entry->hello.incarnation, {}})
            .first;
    put_task(*entry, record, message->second, now);
    turn_ = entry->number;
  }
  for (auto& [number, message] : messages) {
    if (!message.tasks.empty()) send_tasks(*workers_.of_number(number), message, now);
  }
}

/// A worker with an idle slot that has not got the task; null without one.
WorkerEntry* Scheduler::idle_for(const TaskRecord& record) {
  WorkerEntry* found = nullptr;
  in_turn(leases_.loads().with_idle(), turn_, [&](WorkerNumber number) {
    WorkerEntry& entry = *workers_.of_number(number);
    const bool fits = number != record.lease->worker && number != record.avoid;
    if (fits && !is_kept_free(entry)) found = &entry;
    return found == nullptr;
  });
  return found;
}

std::size_t Scheduler::idle_slots() const {
  if (held_ || draining_ || options_.evaluates_programs || leases_.wanted_ready() > 0) return 0;
  const std::size_t idle = leases_.loads().idle();
  return idle - std::min(idle, leases_.ahead_ready());
}

void Scheduler::dispatch_ahead(TimePoint now) {
  if (leases_.ahead_ready() == 0) return;
  in_turn(leases_.loads().with_idle(), turn_,
          [&](WorkerNumber number) { return fill_ahead(*workers_.of_number(number), now); });
}

/// Only to slots that would idle: what is wanted next never waits behind a queue of it. False when
/// none is left.
bool Scheduler::fill_ahead(WorkerEntry& entry, TimePoint now) {
  if (is_kept_free(entry)) return true;
  const bool elsewhere = workers_.trusted() > 1;
  SendTasks message{entry.peer, entry.hello.incarnation, {}};
  for (std::size_t room = leases_.loads().of(entry.number).idle(); room > 0; --room) {
    TaskRecord* record = leases_.next_ahead(entry.number, elsewhere);
    if (record == nullptr) break;
    leases_.grant(*record, entry.number, now);
    ++counters_.ahead;
    put_task(entry, *record, message, now);
  }
  if (message.tasks.empty()) return leases_.ahead_ready() > 0;
  send_tasks(entry, message, now);
  turn_ = entry.number;
  return leases_.ahead_ready() > 0;
}

}  // namespace swarmsmith
