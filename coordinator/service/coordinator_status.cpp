// The part of Coordinator that reports its status.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "coordinator/service/coordinator.h"

namespace swarmsmith {

LiveStatus Coordinator::status() const {
  const SchedulerCounters& counters = scheduler_.counters();
  const auto count = [](auto number) { return static_cast<std::int64_t>(number); };
  LiveStatus status;
  status.workers = count(scheduler_.workers().connected());
  status.gone_workers = count(scheduler_.workers().all().size()) - status.workers;
  status.slots = scheduler_.workers().slots();
  for (const auto& [number, entry] : scheduler_.workers().all())
    status.credit += entry.usable() ? entry.credit : 0;
  status.ready = count(scheduler_.leases().queued());
  status.leased = count(scheduler_.leases().leased());
  status.done = count(counters.done);
  status.rejected = count(counters.rejected);
  status.failed = count(counters.failed);
  status.requeued = count(counters.requeued);
  status.expired = count(counters.expired);
  status.duplicates = count(counters.duplicates);
  status.conflicts = count(counters.conflicts);
  status.unknown = count(counters.unknown);
  status.unleased = count(counters.unleased);
  status.rulings = count(counters.rulings);
  status.referee_queue = count(scheduler_.cases().size());
  status.audits = count(counters.audited);
  status.quarantined =
      count(scheduler_.workers().connected()) - count(scheduler_.workers().trusted());
  status.lost_workers = count(counters.lost_workers);
  status.reconnects = count(counters.reconnects);
  status.malformed = count(malformed_count_);
  status.malformed_by = malformed_;
  status.over_budget = {budgets_.left_out().begin(), budgets_.left_out().end()};
  status.uncommitted = count(waiting_.size());
  status.slot_times = slots_.since_start();
  status.slot_times_last_minute = slots_.last_minute();
  return status;
}

std::int64_t Coordinator::uncommitted(std::uint32_t campaign) const {
  return std::ranges::count_if(waiting_, [&](const auto& entry) {
    return swarmsmith::campaign_of(entry.first) == campaign;
  });
}

std::vector<QuarantineStatus> Coordinator::quarantine(TimePoint now) const {
  std::vector<QuarantineStatus> all;
  const auto add = [&](const Principal& principal, const Principal::Cause& cause,
                       std::int64_t worker, std::int64_t here) {
    all.push_back(
        {.who = principal.name,
         .reason = cause.reason,
         .since = cause.since,
         .worker = worker,
         .workers = here,
         .for_s = cause.since.empty() ? std::chrono::duration<double>(now - cause.at).count() : 0});
  };
  const auto& workers = scheduler_.workers().all();
  for (const auto& [name, principal] : scheduler_.principals().all()) {
    if (principal.quarantined) {
      const auto here = std::ranges::count_if(
          principal.workers, [&](WorkerNumber number) { return workers.at(number).connected; });
      add(principal, principal.cause, 0, here);
      continue;
    }
    for (const auto& liar : principal.liars) {
      const auto one = std::ranges::find_if(principal.workers, [&](WorkerNumber number) {
        return hexadecimal(workers.at(number).hello.identity) == liar.first;
      });
      const bool is_known = one != principal.workers.end();
      add(principal, liar.second, is_known ? *one : 0,
          is_known && workers.at(*one).connected ? 1 : 0);
    }
  }
  return all;
}

std::vector<WorkerStatus> Coordinator::fleet(TimePoint now) const {
  std::vector<WorkerStatus> fleet;
  fleet.reserve(scheduler_.workers().all().size());
  for (const auto& [number, entry] : scheduler_.workers().all()) {
    const WorkerRate rate = slots_.rate_of(number);
    const auto held = static_cast<std::int64_t>(scheduler_.leases().leases_of(number).size());
    fleet.push_back(
        {.number = number,
         .state = !entry.connected    ? "gone"
                  : entry.quarantined ? "quarantined"
                                      : "connected",
         .host = entry.hello.host,
         .job = entry.hello.job,
         .client = entry.hello.client,
         .slots = entry.hello.slots,
         .held = held,
         .running = std::min(held, static_cast<std::int64_t>(entry.running)),
         .done = entry.done,
         .failed = entry.failed,
         .connections = static_cast<std::int64_t>(entry.hello.incarnation),
         .done_per_s = rate.done_per_s,
         .busy = rate.busy,
         .last_heard_s = std::chrono::duration<double>(now - entry.last_heard).count()});
  }
  return fleet;
}

}  // namespace swarmsmith
