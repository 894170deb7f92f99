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

/// A design among those of all campaigns of a coordinator.
struct PoolDesign {
  std::uint32_t campaign = 0;
  std::int64_t design = 0;
  auto operator<=>(const PoolDesign&) const = default;
};

constexpr PoolDesign pool_design_of(PackedKey key) {
  return {campaign_of(key), (candidate_of(key) - 1) / kMostCandidates + 1};
}

/// Ready tasks, a queue for each design, and the choice among the designs (orchestration facts, 5
/// "Order" and 10). Any task costs O(log designs).
///
/// First comes the design that is the nearest to a barrier: what is still queued of it fits the
/// free places, so that the whole of its step is on its way then. Of several the one with the
/// fewest tasks outstanding. Otherwise the design that has *had* least: start-time fair queueing
/// (Goyal and others 1996) by time, in microseconds of evaluation as estimated when a task is
/// leased. Time and not tasks, since campaigns of 2 ms and of 50 ms share a pool; and what was had
/// and not what is held now, since with fewer slots than designs the last ones would wait for ever.
/// A design that had nothing to do for a while does not save up its share. Urgency is charged like
/// any lease, and a design that got more than `allowance_us` above the others because of it is not
/// urgent before they have caught up.
///
/// Look-ahead has its own queues; the one with the fewest leased tasks comes first.
class DesignQueues {
 public:
  using Place = std::list<PackedKey>::iterator;

  /// What a design has and had.
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

  /// Made when it is asked for; stays where it is until its campaign is forgotten.
  Design& design(PoolDesign id);

  Place push_back(Design& design, bool ahead, PackedKey key);
  Place push_front(Design& design, bool ahead, PackedKey key);
  void erase(Design& design, bool ahead, Place place);

  /// A task of the design is leased, at this cost; to be said before it leaves its queue.
  void on_leased(Design& design, bool ahead, std::uint64_t cost_us);
  void on_unleased(Design& design, bool ahead);
  /// A leased task of look-ahead is wanted now.
  void on_promoted(Design& design);

  /// Nothing more of the design is ready, or again; design 0 stands for the whole campaign, and a
  /// design is ready when neither is held.
  void hold(PoolDesign id, bool held);
  bool is_held(PoolDesign id) const;
  /// As they were held; design 0 stands for a campaign.
  const std::set<PoolDesign>& held() const { return held_; }
  /// Its tasks must be gone.
  void forget(std::uint32_t campaign);

  using Fits = std::function<bool(PackedKey)>;
  /// The task that should be leased next, among those that fit. `free` is how many the workers have
  /// room for.
  std::optional<PackedKey> next(std::size_t free, std::uint64_t allowance_us,
                                const Fits& fits) const;
  std::optional<PackedKey> next_ahead(const Fits& fits) const;

  /// Ready ones: not of designs that are held.
  std::size_t wanted() const { return wanted_; }
  std::size_t ahead() const { return ahead_; }
  /// Held ones too; design 0 stands for the whole campaign.
  std::size_t wanted_of(PoolDesign id) const;
  const std::map<PoolDesign, Design>& all() const { return designs_; }

 private:
  using Order = Design::Order;

  /// To be called around any change of a design.
  template <class Change>
  void change(Design& design, const Change& make);
  static void put(Order& order, std::optional<Order::iterator>& at, bool ready, std::uint64_t rank,
                  Design& design);
  bool is_urgent(const Design& design, std::size_t free, std::uint64_t allowance_us) const;

  std::map<PoolDesign, Design> designs_;
  /// Designs with ready tasks; with ready look-ahead.
  Order by_had_, by_outstanding_, by_ahead_;
  std::set<PoolDesign> held_;
  std::uint64_t had_us_ = 0;  ///< by the design that had least when a task was last leased
  std::size_t wanted_ = 0;
  std::size_t ahead_ = 0;
};

}  // namespace swarmsmith
