#pragma once

#include <span>
#include <vector>

#include "sim/engine/internal/island.h"
#include "sim/engine/internal/mover.h"
#include "sim/engine/internal/places.h"
#include "sim/engine/internal/surroundings.h"

namespace swarmsmith {

/// All movers at one instant, as input to the reach test.
struct Swarm {
  std::span<const Mover> movers;
  const Places& places;  ///< the positions of the same movers
  /// An upper bound for the speed and the commanded speed of all centres.
  double speed_limit_mps = 0;
};

/// Finds the movers whose motion cannot be free, in two stages: first bounding circles, then the
/// gap along a separating axis compared with how far both can move and how far their corners can
/// swing (simulator facts, section 2.3). It never misses a contact, but predicts about four times
/// as many as occur. A mover that may be pushed is assumed as fast as the mover that may push it.
/// Movers that touch and rest are free, as long as no moving mover can reach them.
class Reach {
 public:
  /// `surroundings` must outlive the object; `largest_radius_m` is an upper bound for the radius of
  /// all movers.
  Reach(const Surroundings& surroundings, std::size_t movers, double largest_radius_m);

  /// The islands of the coming `sub_steps`; movers outside all islands move freely. Valid until the
  /// next call.
  std::span<const Island> find(const Swarm& swarm, int sub_steps);

  /// Whether the mover was in no island in the last call.
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
  std::vector<Pair> near_;            ///< pairs that may touch, including by being pushed
  std::vector<int> room_;             ///< for indices of movers
  std::vector<std::size_t> parent_;   ///< union-find; the root is the first mover of its group
  std::vector<std::size_t> grouped_;  ///< movers in groups of two or more
  std::vector<char> in_group_;        ///< the same as a flag for each mover
  std::vector<std::size_t> island_;   ///< index of the island of a root's group
  std::vector<double> margin_m_;      ///< how far any point of the body can move
  std::vector<double> speed_mps_;     ///< the highest speed of any point of the body
  std::vector<char> in_island_;
  std::vector<Island> islands_;
  std::size_t count_ = 0;
};

}  // namespace swarmsmith
