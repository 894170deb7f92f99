#pragma once

#include <span>
#include <vector>

#include "sim/engine/internal/island.h"
#include "sim/engine/internal/mover.h"
#include "sim/engine/internal/places.h"
#include "sim/engine/internal/surroundings.h"

namespace swarmsmith {

/// All movers at one instant, as the reach test wants them.
struct Swarm {
  std::span<const Mover> movers;
  const Places& places;  ///< of the same movers
  /// No centre moves faster, nor is asked to.
  double speed_limit_mps = 0;
};

/// Finds the movers whose motion cannot be free, in two stages: bounding circles, then the gap
/// along a separating axis against how far both can move and how far their corners can swing
/// (simulator facts, section 2.3). Never misses a touch; says "may" about four times as often as
/// there is one. A mover that may be pushed counts as fast as what may push it. Movers that touch
/// and rest are free, as long as nothing that moves reaches them.
class Reach {
 public:
  /// `surroundings` must outlive the object; no mover is wider than `largest_radius_m` from its
  /// centre.
  Reach(const Surroundings& surroundings, std::size_t movers, double largest_radius_m);

  /// The islands of the coming `sub_steps`; movers in none move freely. Valid until the next call.
  std::span<const Island> find(const Swarm& swarm, int sub_steps);

  /// Whether the last call put the mover into no island.
  bool is_free(int mover) const { return !in_island_[static_cast<std::size_t>(mover)]; }

 private:
  struct Pair {
    std::size_t a;
    std::size_t b;
  };

  bool any_pair_near(const Swarm& swarm, double span_s);
  bool any_wall_near(const Swarm& swarm, double span_s) const;
  bool any_obstacle_near(const Swarm& swarm, double span_s) const;
  void bound_motion(const Swarm& swarm, double span_s);
  void list_pairs(const Swarm& swarm, double span_s);
  bool join_pairs(const Swarm& swarm);
  void widen_groups(double span_s);
  bool may_touch(const Swarm& swarm, const Pair& pair) const;
  void gather(const Swarm& swarm);
  void add_surroundings(const Swarm& swarm, std::size_t mover, Island& island) const;
  bool wall_in_reach(const Mover& mover, const WallPlane& wall, double margin_m) const;
  std::size_t root(std::size_t mover) const;

  const Surroundings* surroundings_;
  double largest_radius_m_;
  std::vector<Pair> near_;            ///< pairs that may touch even when pushed
  std::vector<int> room_;             ///< for numbers of movers
  std::vector<std::size_t> parent_;   ///< union-find; the root is the first of its group
  std::vector<std::size_t> grouped_;  ///< movers that were joined to another
  std::vector<char> in_group_;        ///< the same, for each mover
  std::vector<std::size_t> island_;   ///< of a root's group
  std::vector<double> margin_m_;      ///< how far any point of the body can get
  std::vector<double> speed_mps_;     ///< how fast any point of the body can be
  std::vector<char> in_island_;
  std::vector<Island> islands_;
  std::size_t count_ = 0;
};

}  // namespace swarmsmith
