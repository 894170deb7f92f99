#include "sim/engine/internal/sensing.h"

#include <cmath>

#include "sim/engine/internal/robot_senses.h"

namespace swarmsmith {

namespace {

/// How far a robot gets before its rays look around anew.
constexpr double kStroll_m = 0.2;
/// More than rounding takes or gives, metres.
constexpr double kSlack_m = 1e-6;

}  // namespace

ProximityRays::ProximityRays(const World& world, int robot, double range_m)
    : world_(&world),
      robot_(robot),
      range_m_(range_m),
      start_m_(world.is_plain() ? kRayStart_m : ray_start_m(world.form(robot))) {
  look_around();
}

void ProximityRays::look_around() {
  looked_from_ = world_->body(robot_);
  const double reach = start_m_ + range_m_ + kStroll_m + kSlack_m;
  find_walls_near(world_->walls(), looked_from_, reach, walls_);
  obstacles_.clear();
  for (const FixedSolid& obstacle : world_->obstacles()) {
    if (obstacle.form.height_m < kProximityHeight_m) continue;
    const double sight = reach + obstacle.form.radius_m;
    if (distance2_of(looked_from_, obstacle.at) > sight * sight) continue;
    obstacles_.push_back(&obstacle);
  }
}

void ProximityRays::cast(RayDistances& distances) {
  const Body& self = world_->body(robot_);
  if (distance2_of(self, looked_from_) > kStroll_m * kStroll_m) look_around();
  meet_walls(self, start_m_, walls_, range_m_, distances);
  if (!world_->is_plain()) return meet_solids(distances);
  world_->visit_near(robot_, sight_of_robots_m(range_m_), room_, [&](int other) {
    meet_robot(self, world_->body(other), range_m_, distances);
  });
}

/// What else than walls there is to meet, where not all are RVRs. Rays pass above what is low.
void ProximityRays::meet_solids(RayDistances& distances) {
  const Body& self = world_->body(robot_);
  const double sight = start_m_ + range_m_ + world_->largest_radius_m() + kSlack_m;
  world_->visit_near(robot_, sight, room_, [&](int other) {
    if (world_->form(other).height_m < kProximityHeight_m) return;
    meet_solid(self, start_m_, world_->form(other), world_->body(other), range_m_, distances);
  });
  for (const FixedSolid* obstacle : obstacles_)
    meet_solid(self, start_m_, obstacle->form, obstacle->at, range_m_, distances);
}

RayDistances ray_distances(const World& world, int robot, double range_m) {
  RayDistances distances;
  ProximityRays(world, robot, range_m).cast(distances);
  return distances;
}

void find_neighbours(const World& world, int robot, std::vector<int>& room,
                     std::vector<Neighbour>& found) {
  found.clear();
  const Body& self = world.body(robot);
  world.visit_near(robot, kNeighbourRange_m, room, [&](int other) {
    const double dx = world.body(other).x - self.x;
    const double dy = world.body(other).y - self.y;
    const double distance2 = dx * dx + dy * dy;
    if (other >= world.robots() || distance2 >= kNeighbourRange_m * kNeighbourRange_m) return;
    const double distance = std::sqrt(distance2);
    Neighbour neighbour{.distance_m = distance};
    if (distance > 0) {
      neighbour.direction_x = (self.cos * dx + self.sin * dy) / distance;
      neighbour.direction_y = (self.cos * dy - self.sin * dx) / distance;
    }
    found.push_back(neighbour);
  });
}

}  // namespace swarmsmith
