#pragma once

#include <vector>

#include "sim/engine/internal/rays.h"
#include "sim/engine/internal/sight.h"
#include "sim/engine/internal/world.h"

namespace swarmsmith {

/// The measurements of a robot's ideal sensors in the present world.

/// The proximity rays of one robot. It remembers the walls and obstacles near its position, so that
/// rays are cheap where nothing is near.
class ProximityRays {
 public:
  /// `world` must outlive the object, and its robots must be at their start poses.
  ProximityRays(const World& world, int robot, double range_m);

  /// Distances along the proximity directions to the nearest wall, robot, obstacle or object; exact
  /// up to the range; beyond it they are at least the range.
  void cast(RayDistances& distances);

 private:
  void look_around();
  void meet_solids(RayDistances& distances);

  const World* world_;
  int robot_;
  double range_m_;
  double start_m_;
  bool along_lines_;  ///< whether its ring is the RVR's, for which there are faster functions
  Body looked_from_;
  Walls walls_;  ///< the walls near that place
  std::vector<const FixedSolid*> obstacles_;
  std::vector<int> room_;  ///< for indices of movers
};

/// The same, computed once.
RayDistances ray_distances(const World& world, int robot, double range_m);

/// The robots within the range of its sensor as an omnidirectional camera sees them, in the order
/// of their numbers, without hidden ones; replaces the content of `found`. `room` is working
/// memory.
void find_neighbours(const World& world, const Sight& sight, int robot, std::vector<int>& room,
                     std::vector<Neighbour>& found);

/// Another robot as a sensor on the robot's axis measures it; see NeighbourSensor.
Neighbour neighbour_of(const World& world, int robot, int other);

}  // namespace swarmsmith
