#include "sim/engine/internal/sensing.h"

#include <cmath>
#include <limits>

#include "sim/engine/internal/robot_senses.h"

namespace swarmsmith {

namespace {

/// What else than walls there is to meet, where not all are RVRs. Rays pass above what is low.
void meet_solids(const World& world, int robot, double range_m, RayDistances& distances) {
  const Body& self = world.body(robot);
  const double start = ray_start_m(world.form(robot));
  for (int other = 0; other < world.movers(); ++other) {
    if (other == robot || world.form(other).height_m < kProximityHeight_m) continue;
    meet_solid(self, start, world.form(other), world.body(other), range_m, distances);
  }
  for (const FixedSolid& obstacle : world.obstacles()) {
    if (obstacle.form.height_m < kProximityHeight_m) continue;
    meet_solid(self, start, obstacle.form, obstacle.at, range_m, distances);
  }
}

}  // namespace

RayDistances ray_distances(const World& world, int robot, double range_m) {
  RayDistances distances;
  distances.fill(std::numeric_limits<double>::infinity());
  const Body& self = world.body(robot);
  if (!world.is_plain()) {
    meet_walls(self, ray_start_m(world.form(robot)), world.walls(), range_m, distances);
    meet_solids(world, robot, range_m, distances);
    return distances;
  }
  meet_walls(self, kRayStart_m, world.walls(), range_m, distances);
  const double sight = sight_of_robots_m(range_m);
  for (int other = 0; other < world.robots(); ++other) {
    if (other == robot || world.distance2(robot, other) > sight * sight) continue;
    meet_robot(self, world.body(other), range_m, distances);
  }
  return distances;
}

void find_neighbours(const World& world, int robot, std::vector<Neighbour>& found) {
  found.clear();
  const Body& self = world.body(robot);
  for (int other = 0; other < world.robots(); ++other) {
    const double distance2 = world.distance2(robot, other);
    if (other == robot || distance2 >= kNeighbourRange_m * kNeighbourRange_m) continue;
    const double distance = std::sqrt(distance2);
    const double dx = world.body(other).x - self.x;
    const double dy = world.body(other).y - self.y;
    Neighbour neighbour{.distance_m = distance};
    if (distance > 0) {
      neighbour.direction_x = (self.cos * dx + self.sin * dy) / distance;
      neighbour.direction_y = (self.cos * dy - self.sin * dx) / distance;
    }
    found.push_back(neighbour);
  }
}

}  // namespace swarmsmith
