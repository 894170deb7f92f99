#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>

#include "coordinator/pool/scheduler.h"
#include "coordinator/pool/slot_times.h"

namespace swarmsmith {

/// Why nothing is leased at all, if so.
enum class Holding { No, Commit, Other };

/// What a worker's slots did lately.
struct WorkerRate {
  double done_per_s = 0;
  double busy = 0;  ///< share of its slots' time
};

/// Where the slots' time goes. Pure.
///
/// How long slots evaluated is the worker's own measure, which its heartbeats bring. Why they did
/// not is what the coordinator sees ten times a second: each sample finds, of the slots of a
/// worker, those that have no lease, and their cause. From one heartbeat of a worker to the next,
/// idle time = slot time - busy time, exactly; the causes get what the samples say, all of them
/// shortened alike if that is more; what remains is the network's: leased, and not evaluated.
class SlotAccount {
 public:
  /// Call it ten times a second, after leasing.
  void sample(const Scheduler& scheduler, Holding holding, TimePoint now);

  const SlotTimes& since_start() const { return total_; }
  /// Of about the last 60 s; of all time while that is less.
  SlotTimes last_minute() const;
  WorkerRate rate_of(WorkerNumber worker) const;

 private:
  /// At some time.
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
    std::int64_t slot_us = 0;  ///< of the last report that was settled
    std::int64_t busy_us = 0;
    std::array<double, kIdleCauses> unleased{};  ///< since then, seconds
    Mark mark;
    WorkerRate rate;
  };

  void settle(Worker& worker, const WorkerEntry& entry, TimePoint now);

  std::map<WorkerNumber, Worker> workers_;
  SlotTimes total_;
  std::deque<std::pair<TimePoint, SlotTimes>> past_;  ///< a second apart
};

}  // namespace swarmsmith
