#include "coordinator/pool/slot_account.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "base/assert.h"

namespace swarmsmith {
namespace {

constexpr Duration kPastEvery = std::chrono::seconds(1);
constexpr Duration kPast = std::chrono::minutes(1);
constexpr Duration kRateEvery = std::chrono::seconds(5);
constexpr Duration kLongestSample = std::chrono::seconds(1);
/// A worker's clock and ours may differ in the length of a second, but only slightly.
constexpr Duration kPatience = std::chrono::seconds(5);

double seconds(Duration time) {
  return std::chrono::duration<double>(time).count();
}

/// The reason why no task is ready. Queued look-ahead does not count as work that is held back.
IdleCause cause_without_ready(const LeaseTable& leases) {
  IdleCause cause = IdleCause::Barrier;
  for (const PoolDesign& held : leases.queues().held()) {
    if (leases.wanted_of(held) == 0) continue;
    // A whole campaign is held because of its store; a single design, because people paused it.
    if (held.design == 0) return IdleCause::Commit;
    cause = IdleCause::Held;
  }
  return cause;
}

/// None if the slots are about to get work. `without_ready` is the cause if no task is ready.
std::optional<IdleCause> cause_of(const Scheduler& scheduler, const WorkerEntry& worker,
                                  std::int64_t held, Holding holding,
                                  std::optional<IdleCause> without_ready) {
  // The first cause that holds explains the idle slot.
  if (holding == Holding::Commit) return IdleCause::Commit;
  if (holding == Holding::Other || scheduler.held()) return IdleCause::Held;
  if (!worker.asked) return IdleCause::StartUp;
  if (without_ready) return without_ready;
  if (held >= static_cast<std::int64_t>(worker.credit)) return IdleCause::Credit;
  const bool alone = worker.reserved || scheduler.leases().has_alone();
  return alone ? std::optional(IdleCause::Alone) : std::nullopt;
}

}  // namespace

std::string_view name_of(IdleCause cause) {
  static constexpr std::array<std::string_view, kIdleCauses> kNames = {
      "start-up", "barrier", "credit", "network", "commit", "held", "alone"};
  return kNames[static_cast<std::size_t>(cause)];
}

double SlotTimes::idle_total() const {
  return std::accumulate(idle.begin(), idle.end(), 0.0);
}

void SlotAccount::sample(const Scheduler& scheduler, Holding holding, TimePoint now) {
  const LeaseTable& leases = scheduler.leases();
  std::optional<IdleCause> without_ready;
  if (leases.wanted_ready() == 0 && !leases.has_alone()) {
    without_ready = cause_without_ready(leases);
  }
  for (const auto& [number, entry] : scheduler.workers().all()) {
    if (!entry.usable()) {
      // Its activity since the last heartbeat is unknown.
      workers_.erase(number);
      continue;
    }
    Worker& worker = workers_[number];
    if (worker.incarnation != entry.hello.incarnation) {
      worker = {.incarnation = entry.hello.incarnation, .sampled = now, .settled = now};
      worker.mark = {.when = now, .done = entry.done};
      continue;
    }
    // A task that another worker finished first occupies a slot until this worker reports it.
    const auto held = static_cast<std::int64_t>(leases.loads().of(number).held());
    const std::int64_t free = std::max<std::int64_t>(0, entry.hello.slots - held);
    const auto cause = cause_of(scheduler, entry, held, holding, without_ready);
    if (cause && free > 0) {
      // A pause of this process, or a clock that was set back, says nothing about the slots.
      const Duration time = std::clamp(now - worker.sampled, Duration{0}, kLongestSample);
      worker.unleased[static_cast<std::size_t>(*cause)] +=
          static_cast<double>(free) * seconds(time);
    }
    worker.sampled = now;
    if (entry.slot_us > worker.slot_us) settle(worker, entry, now);
  }
  std::erase_if(workers_,
                [&](const auto& one) { return !scheduler.workers().all().contains(one.first); });
  if (past_.empty() || now - past_.back().first >= kPastEvery) past_.emplace_back(now, total_);
  while (past_.size() > 1 && now - past_[1].first >= kPast)
    past_.pop_front();
}

void SlotAccount::settle(Worker& worker, const WorkerEntry& entry, TimePoint now) {
  // A worker that lies about its time cannot claim more time than has passed.
  const Duration at_most = std::max(now - worker.settled, Duration{0}) + kPatience;
  const double most = entry.hello.slots * seconds(at_most);
  const double slots = std::min(static_cast<double>(entry.slot_us - worker.slot_us) * 1e-6, most);
  const double busy =
      std::clamp(static_cast<double>(entry.busy_us - worker.busy_us) * 1e-6, 0.0, slots);
  const double idle = slots - busy;
  SWARMSMITH_ASSERT(busy >= 0 && idle >= 0, "slot time is busy time and idle time");
  const double unleased = std::accumulate(worker.unleased.begin(), worker.unleased.end(), 0.0);
  // Samples are estimates, and idle time is measured: the causes never get more than that.
  const double share = unleased > idle ? idle / unleased : 1.0;
  for (std::size_t i = 0; i < kIdleCauses; ++i)
    total_.idle[i] += share * worker.unleased[i];
  total_.idle[static_cast<std::size_t>(IdleCause::Network)] += idle - share * unleased;
  total_.slots += slots;
  total_.busy += busy;
  worker.unleased = {};
  worker.slot_us = entry.slot_us;
  worker.busy_us = entry.busy_us;
  worker.settled = now;
  const Duration since = now - worker.mark.when;
  if (since >= Duration{0} && since < kRateEvery) return;
  if (since >= kRateEvery) {
    const auto slot_us = static_cast<double>(entry.slot_us - worker.mark.slot_us);
    const auto busy_us = static_cast<double>(entry.busy_us - worker.mark.busy_us);
    worker.rate = {
        .done_per_s = static_cast<double>(entry.done - worker.mark.done) / seconds(since),
        .busy = slot_us > 0 ? std::clamp(busy_us / slot_us, 0.0, 1.0) : 0.0};
  }
  worker.mark = {now, entry.done, entry.slot_us, entry.busy_us};
}

SlotTimes SlotAccount::last_minute() const {
  SlotTimes times = total_;
  if (past_.empty()) return times;
  const SlotTimes& before = past_.front().second;
  times.slots -= before.slots;
  times.busy -= before.busy;
  for (std::size_t i = 0; i < kIdleCauses; ++i)
    times.idle[i] -= before.idle[i];
  return times;
}

WorkerRate SlotAccount::rate_of(WorkerNumber worker) const {
  const auto at = workers_.find(worker);
  return at == workers_.end() ? WorkerRate{} : at->second.rate;
}

}  // namespace swarmsmith
