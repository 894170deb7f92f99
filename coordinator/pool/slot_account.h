#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>

#include "coordinator/pool/scheduler.h"
#include "coordinator/pool/slot_times.h"

namespace swarmsmith {

/// The reason why leasing is stopped completely, if it is.
enum class Holding { No, Commit, Other };

/// A worker's recent activity.
struct WorkerRate {
  double done_per_s = 0;
  double busy = 0;  ///< share of its slots' time
};

/// Accounts for the time of all slots. Pure.
///
/// Workers measure the time during which their slots evaluate, and report it in heartbeats. The
/// coordinator finds the reasons for idle slots ten times a second: each sample counts the slots of
/// a worker without a lease, and their cause. From one heartbeat of a worker to the next, idle time
/// = slot time - busy time, exactly. The causes get the time found by the samples, all scaled down
/// by the same factor if their sum is larger; the rest counts as network time: leased, and not
/// evaluated.
class SlotAccount {
 public:
  /// Call this ten times a second, after leasing.
  void sample(const Scheduler& scheduler, Holding holding, TimePoint now);

  const SlotTimes& since_start() const { return total_; }
  /// The last 60 s, approximately; all of the time if that is shorter.
  SlotTimes last_minute() const;
  WorkerRate rate_of(WorkerNumber worker) const;

 private:
  /// The values at some time.
  struct Mark {
    TimePoint when;
    std::int64_t done = 0;
    std::int64_t slot_us = 0;
    std::int64_t busy_us = 0;
  };
  struct Worker {
    std::uint64_t incarnation = 0;
    TimePoint sampled;
    TimePoint settled;
    std::int64_t slot_us = 0;  ///< in the last report that was settled
    std::int64_t busy_us = 0;
    std::array<double, kIdleCauses> unleased{};  ///< seconds since then
    Mark mark;
    WorkerRate rate;
  };

  void settle(Worker& worker, const WorkerEntry& entry, TimePoint now);

  std::map<WorkerNumber, Worker> workers_;
  SlotTimes total_;
  std::deque<std::pair<TimePoint, SlotTimes>> past_;  ///< one entry per second
};

}  // namespace swarmsmith
