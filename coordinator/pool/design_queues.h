#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "proto/key.h"

namespace swarmsmith {

/// A design, identified among those of all campaigns of a coordinator.
struct PoolDesign {
  std::uint32_t campaign = 0;
  std::int64_t design = 0;
  auto operator<=>(const PoolDesign&) const = default;
};

constexpr PoolDesign pool_design_of(PackedKey key) {
  return {campaign_of(key), (candidate_of(key) - 1) / kMostCandidates + 1};
}

/// The ready tasks, in a queue for each design, and the selection among the designs (orchestration
/// facts, 5 "Order" and 10). Each operation on a task costs O(log designs).
///
/// The design that is nearest to a barrier comes first: its queued tasks fit into the free places,
/// so that its whole step is under way then. Among several such designs, it is the one with the
/// fewest outstanding tasks. If there is none, the design that has *had* the least time comes
/// first: start-time fair queueing (Goyal and others 1996), measured in microseconds of evaluation
/// as estimated when a task is leased. Time counts and not the number of tasks, because campaigns
/// with evaluations of 2 ms and of 50 ms share a pool. Past time counts and not the current leases,
/// because with fewer slots than designs the last designs would wait for ever. A design that had
/// nothing to do for a while does not accumulate a claim to more. Urgent tasks are charged like all
/// leases, and a design that thereby got more than `allowance_us` above the others is not urgent
/// until they have caught up.
///
/// Look-ahead tasks have separate queues; the design with the fewest leased ones comes first.
class DesignQueues {
 public:
  using Place = std::list<PackedKey>::iterator;

  /// The tasks of a design, and the time that it has had.
  struct Design {
    PoolDesign id;
    std::list<PackedKey> wanted;
    std::list<PackedKey> ahead;
    std::size_t wanted_leased = 0;
    std::size_t ahead_leased = 0;
    std::uint64_t had_us = 0;
    bool held = false;

    std::size_t outstanding() const { return wanted.size() + wanted_leased; }

   private:
    friend class DesignQueues;
    struct Ranked {
      std::uint64_t rank;
      PoolDesign id;
      Design* design;
      bool operator<(const Ranked& other) const {
        return std::pair(rank, id) < std::pair(other.rank, other.id);
      }
    };
    using Order = std::set<Ranked>;
    std::optional<Order::iterator> by_had, by_outstanding, by_ahead;
  };

  /// Created on first use; its address does not change until its campaign is forgotten.
  Design& design(PoolDesign id);

  Place push_back(Design& design, bool ahead, PackedKey key);
  Place push_front(Design& design, bool ahead, PackedKey key);
  void erase(Design& design, bool ahead, Place place);

  /// A task of the design is leased, at this cost; call before the task leaves its queue.
  void on_leased(Design& design, bool ahead, std::uint64_t cost_us);
  void on_unleased(Design& design, bool ahead);
  /// A leased look-ahead task is wanted now.
  void on_promoted(Design& design);

  /// Holds or releases the design: its tasks are not ready while it is held. Design 0 means the
  /// whole campaign; a design is ready if neither the design nor its campaign is held.
  void hold(PoolDesign id, bool held);
  bool is_held(PoolDesign id) const;
  /// As passed to `hold`; design 0 means a whole campaign.
  const std::set<PoolDesign>& held() const { return held_; }
  /// The campaign must have no tasks left.
  void forget(std::uint32_t campaign);

  using Fits = std::function<bool(PackedKey)>;
  /// The task to lease next, among those for which `fits` returns true. `free` is the number of
  /// tasks for which the workers have room.
  std::optional<PackedKey> next(std::size_t free, std::uint64_t allowance_us,
                                const Fits& fits) const;
  std::optional<PackedKey> next_ahead(const Fits& fits) const;

  /// The number of ready tasks: without those of designs that are held.
  std::size_t wanted() const { return wanted_; }
  std::size_t ahead() const { return ahead_; }
  /// Includes tasks of held designs; design 0 means the whole campaign.
  std::size_t wanted_of(PoolDesign id) const;
  const std::map<PoolDesign, Design>& all() const { return designs_; }

 private:
  using Order = Design::Order;

  /// Every change of a design must go through this function.
  template <class Change>
  void change(Design& design, const Change& make);
  static void put(Order& order, std::optional<Order::iterator>& at, bool ready, std::uint64_t rank,
                  Design& design);
  bool is_urgent(const Design& design, std::size_t free, std::uint64_t allowance_us) const;

  std::map<PoolDesign, Design> designs_;
  /// Designs with ready tasks, and designs with ready look-ahead tasks.
  Order by_had_, by_outstanding_, by_ahead_;
  std::set<PoolDesign> held_;
  std::uint64_t had_us_ = 0;  ///< of the design that had the least time when a task was last leased
  std::size_t wanted_ = 0;
  std::size_t ahead_ = 0;
};

}  // namespace swarmsmith
