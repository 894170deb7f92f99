#include "sim/engine/internal/sensing.h"

#include <cmath>

#include "sim/engine/internal/robot_senses.h"

namespace swarmsmith {

namespace {

/// Distance that a robot moves before its rays search their surroundings again.
constexpr double kStroll_m = 0.2;
/// Larger than any rounding error, metres.
constexpr double kSlack_m = 1e-6;

}  // namespace

ProximityRays::ProximityRays(const World& world, int robot, double range_m)
    : world_(&world),
      robot_(robot),
      range_m_(range_m),
      start_m_(ray_start_m(world.robot().proximity, world.form(robot))),
      along_lines_(world.proximity_ring() == ring_of(ProximityRing::rvr_ring())) {
  look_around();
}

void ProximityRays::look_around() {
  looked_from_ = world_->body(robot_);
  const double reach = start_m_ + range_m_ + kStroll_m + kSlack_m;
  find_walls_near(world_->walls(), looked_from_, reach, walls_);
  obstacles_.clear();
  for (const FixedSolid& obstacle : world_->obstacles()) {
    if (obstacle.form.height_m < world_->robot().proximity.height_m) continue;
    const double sight = reach + obstacle.form.radius_m;
    if (distance2_of(looked_from_, obstacle.at) > sight * sight) continue;
    obstacles_.push_back(&obstacle);
  }
}

void ProximityRays::cast(RayDistances& distances) {
  const Body& self = world_->body(robot_);
  if (distance2_of(self, looked_from_) > kStroll_m * kStroll_m) look_around();
  if (!along_lines_) {
    meet_walls(self, world_->proximity_ring(), start_m_, walls_, range_m_, distances);
    return meet_solids(distances);
  }
  meet_walls(self, start_m_, walls_, range_m_, distances);
  if (!world_->is_plain()) return meet_solids(distances);
  world_->visit_near(robot_, sight_of_robots_m(range_m_), room_, [&](int other) {
    meet_robot(self, world_->body(other), range_m_, distances);
  });
}

/// Shortens the rays at all bodies except walls, for worlds where not all bodies are RVRs. Rays
/// pass above low bodies.
void ProximityRays::meet_solids(RayDistances& distances) {
  const Body& self = world_->body(robot_);
  const Ring& ring = world_->proximity_ring();
  const double sight = start_m_ + range_m_ + world_->largest_radius_m() + kSlack_m;
  world_->visit_near(robot_, sight, room_, [&](int other) {
    if (world_->form(other).height_m < world_->robot().proximity.height_m) return;
    meet_solid(self, ring, start_m_, world_->form(other), world_->body(other), range_m_, distances);
  });
  for (const FixedSolid* obstacle : obstacles_)
    meet_solid(self, ring, start_m_, obstacle->form, obstacle->at, range_m_, distances);
}

RayDistances ray_distances(const World& world, int robot, double range_m) {
  RayDistances distances{};
  ProximityRays(world, robot, range_m).cast(distances);
  return distances;
}

namespace {

/// A robot at (dx, dy) from `self`, on the axes of the arena; `less_m` as in NeighbourSensor.
Neighbour neighbour_at(const Body& self, double dx, double dy, double distance2, double less_m) {
  const double distance = std::sqrt(distance2);
  Neighbour neighbour{.distance_m = distance - less_m};
  if (distance > 0) {
    neighbour.direction_x = (self.cos * dx + self.sin * dy) / distance;
    neighbour.direction_y = (self.cos * dy - self.sin * dx) / distance;
  }
  return neighbour;
}

}  // namespace

Neighbour neighbour_of(const World& world, int robot, int other) {
  const Body& self = world.body(robot);
  const double dx = world.body(other).x - self.x;
  const double dy = world.body(other).y - self.y;
  return neighbour_at(self, dx, dy, dx * dx + dy * dy, world.robot().neighbours.less_m);
}

namespace {

template <class IsSeen>
[[gnu::always_inline]] inline void look_for(const World& world, int robot, std::vector<int>& room,
                                            std::vector<Neighbour>& found, const IsSeen& is_seen) {
  const Body& self = world.body(robot);
  const double range_m = world.robot().neighbours.range_m;
  const double less_m = world.robot().neighbours.less_m;
  const double range2 = range_m * range_m;
  world.visit_near(robot, range_m, room, [&](int other) {
    const double dx = world.body(other).x - self.x;
    const double dy = world.body(other).y - self.y;
    const double distance2 = dx * dx + dy * dy;
    if (other >= world.robots() || distance2 >= range2 || !is_seen(other)) return;
    found.push_back(neighbour_at(self, dx, dy, distance2, less_m));
  });
}

/// For worlds in which something may be in between.
[[gnu::noinline]] void look_past_things(const World& world, const Sight& sight, int robot,
                                        std::vector<int>& room, std::vector<Neighbour>& found) {
  std::vector<int> between;
  look_for(world, robot, room, found,
           [&](int other) { return !sight.is_hidden(robot, other, between); });
}

}  // namespace

void find_neighbours(const World& world, const Sight& sight, int robot, std::vector<int>& room,
                     std::vector<Neighbour>& found) {
  found.clear();
  if (!sight.is_clear()) return look_past_things(world, sight, robot, room, found);
  look_for(world, robot, room, found, [](int) { return true; });
}

}  // namespace swarmsmith
