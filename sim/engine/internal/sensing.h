#pragma once

#include <vector>

#include "sim/engine/internal/rays.h"
#include "sim/engine/internal/sight.h"
#include "sim/engine/internal/world.h"

namespace swarmsmith {

/// What a robot's ideal sensors meet in the world as it is.

/// The proximity rays of one robot. It keeps in mind which walls and obstacles it may meet at its
/// place and a little way around, so that where nothing is near little is looked at.
class ProximityRays {
 public:
  /// `world` must outlive the object, and have its robots at the places where they start.
  ProximityRays(const World& world, int robot, double range_m);

  /// Distances along the proximity directions to the nearest wall, robot, obstacle or object; exact
  /// up to the range, at least as long beyond it.
  void cast(RayDistances& distances);

 private:
  void look_around();
  void meet_solids(RayDistances& distances);

  const World* world_;
  int robot_;
  double range_m_;
  double start_m_;
  bool along_lines_;  ///< its ring is the RVR's: there are quicker ways
  Body looked_from_;
  Walls walls_;  ///< those near that place
  std::vector<const FixedSolid*> obstacles_;
  std::vector<int> room_;  ///< for numbers of movers
};

/// The same, once.
RayDistances ray_distances(const World& world, int robot, double range_m);

/// The robots within the range of its sensor as an omnidirectional camera sees them, in the order
/// of their numbers, but for those that are hidden; replaces what was in `found`. `room` is room to
/// work in.
void find_neighbours(const World& world, const Sight& sight, int robot, std::vector<int>& room,
                     std::vector<Neighbour>& found);

/// Another robot as a sensor on the robot's axis has it, as NeighbourSensor says.
Neighbour neighbour_of(const World& world, int robot, int other);

}  // namespace swarmsmith
