#pragma once

#include <span>
#include <vector>

#include "sim/engine/internal/body.h"
#include "sim/engine/internal/walls.h"

namespace swarmsmith {

/// Robots that may touch each other, or walls, within the coming sub-steps.
struct Island {
  std::vector<int> robots;  ///< ascending
  std::vector<int> walls;   ///< ascending

  friend bool operator==(const Island&, const Island&) = default;
};

/// All bodies at one instant, as the reach test wants them.
struct Swarm {
  std::span<const Body> bodies;
  std::span<const SetPoint> set_points;
  /// (robots x robots), squares of the distances between the centres.
  std::span<const double> distances2;
  /// No body moves faster, nor is asked to.
  double speed_limit_mps = 0;
};

/// Finds the robots whose motion cannot be free, in two stages: bounding circles, then the gap
/// along a separating axis against how far both can move and how far their corners can swing
/// (simulator facts, section 2.3). Never misses a touch; says "may" about four times as often as
/// there is one. A robot that may be pushed counts as fast as what may push it.
class Reach {
 public:
  /// `walls` must outlive the object.
  Reach(const Walls& walls, int robots);

  /// The islands of the coming `sub_steps`; robots in none move freely. Valid until the next call.
  std::span<const Island> find(const Swarm& swarm, int sub_steps);

  /// Whether the last call put the robot into no island.
  bool is_free(int robot) const { return !in_island_[static_cast<std::size_t>(robot)]; }

 private:
  bool any_pair_near(const Swarm& swarm, double span_s) const;
  bool any_wall_near(const Swarm& swarm, double span_s) const;
  void bound_motion(const Swarm& swarm, double span_s);
  bool join_pairs(const Swarm& swarm);
  void widen_groups(double span_s);
  void gather(const Swarm& swarm);
  void add_walls(const Swarm& swarm, Island& island) const;
  bool wall_in_reach(const Body& body, const WallPlane& wall, double margin_m) const;
  int root(int robot) const;

  const Walls* walls_;
  std::vector<int> parent_;        ///< union-find
  std::vector<double> margin_m_;   ///< how far any point of the body can get
  std::vector<double> speed_mps_;  ///< how fast any point of the body can be
  std::vector<char> in_island_;
  std::vector<Island> islands_;
  std::size_t count_ = 0;
};

}  // namespace swarmsmith
