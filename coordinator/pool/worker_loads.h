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

/// What a worker holds, and how much it may.
struct WorkerLoad {
  std::list<PackedKey> leases;  ///< the oldest first
  std::size_t ahead = 0;        ///< of these: look-ahead
  /// What it was given and another worker finished: it has them still, so they take its places
  /// until it says what came of them. With the time of its last word about them.
  std::unordered_map<PackedKey, TimePoint> lingering;
  std::size_t slots = 0;
  std::size_t credit = 0;  ///< how many it wants to hold

  std::size_t held() const { return leases.size() + lingering.size(); }
  /// How many more it may have.
  std::size_t room() const { return credit > held() ? credit - held() : 0; }
  /// Slots that have nothing to do, and want something.
  std::size_t idle() const {
    const std::size_t unused = slots > held() ? slots - held() : 0;
    return unused < room() ? unused : room();
  }
};

/// Leases by worker, and who has room; each call O(log workers).
class WorkerLoads {
 public:
  using Place = std::list<PackedKey>::iterator;

  /// Zero for one that is not there; what lingered there is forgotten.
  void set_capacity(WorkerNumber worker, std::size_t slots, std::size_t credit);
  Place lease(WorkerNumber worker, PackedKey key, bool ahead);
  void end(WorkerNumber worker, Place place, bool ahead);
  /// One of its look-ahead leases is wanted now.
  void promote(WorkerNumber worker);

  /// The worker still has it, though its lease is over.
  void linger(WorkerNumber worker, PackedKey key, TimePoint since);
  /// Renews it; false when it does not linger there.
  bool renew_lingering(WorkerNumber worker, PackedKey key, TimePoint now);
  /// True when it lingered there.
  bool settle(WorkerNumber worker, PackedKey key);
  /// What was not heard of since then never came there.
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
