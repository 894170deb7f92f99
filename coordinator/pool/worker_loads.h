#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <set>
#include <unordered_map>

#include "base/clock.h"
#include "proto/key.h"

namespace swarmsmith {

/// WorkerRow::id.
using WorkerNumber = std::int64_t;

/// The tasks that a worker holds, and the number that it may hold.
struct WorkerLoad {
  std::list<PackedKey> leases;  ///< the oldest first
  std::size_t ahead = 0;        ///< how many of these are look-ahead
  /// Tasks that it was given and another worker finished: it still has them, so they occupy places
  /// until it reports on them. With the time of its last report about each.
  std::unordered_map<PackedKey, TimePoint> lingering;
  std::size_t slots = 0;
  std::size_t credit = 0;  ///< number of tasks that it wants to hold

  std::size_t held() const { return leases.size() + lingering.size(); }
  /// How many more tasks it may get.
  std::size_t room() const { return credit > held() ? credit - held() : 0; }
  /// The number of slots that have no task and want one.
  std::size_t idle() const {
    const std::size_t unused = slots > held() ? slots - held() : 0;
    return unused < room() ? unused : room();
  }
};

/// The leases of all workers, and the workers with room; each call costs O(log workers).
class WorkerLoads {
 public:
  using Place = std::list<PackedKey>::iterator;

  /// Zero for a worker that is not connected; its lingering tasks are forgotten.
  void set_capacity(WorkerNumber worker, std::size_t slots, std::size_t credit);
  Place lease(WorkerNumber worker, PackedKey key, bool ahead);
  void end(WorkerNumber worker, Place place, bool ahead);
  /// One of its look-ahead leases is wanted now.
  void promote(WorkerNumber worker);

  /// The worker still has the task, although its lease is over.
  void linger(WorkerNumber worker, PackedKey key, TimePoint since);
  /// Renews the time of a lingering task; false if it does not linger there.
  bool renew_lingering(WorkerNumber worker, PackedKey key, TimePoint now);
  /// The worker no longer has the task; true if it lingered there.
  bool settle(WorkerNumber worker, PackedKey key);
  /// Lingering tasks without a report since that time never arrived.
  void settle_older(WorkerNumber worker, TimePoint than);

  const WorkerLoad& of(WorkerNumber worker) const;
  const std::set<WorkerNumber>& with_room() const { return with_room_; }
  const std::set<WorkerNumber>& with_idle() const { return with_idle_; }
  std::size_t room() const { return room_; }
  std::size_t idle() const { return idle_; }

 private:
  template <class Change>
  void change(WorkerNumber worker, const Change& make);

  std::map<WorkerNumber, WorkerLoad> loads_;
  std::set<WorkerNumber> with_room_, with_idle_;
  std::size_t room_ = 0;
  std::size_t idle_ = 0;
};

}  // namespace swarmsmith
