#include "sim/engine/internal/world.h"

#include <algorithm>
#include <cmath>

#include "sim/engine/internal/motion.h"

namespace swarmsmith {
namespace {

/// Friction of walls and all other bodies that robots touch, chosen so that its geometric mean with
/// the robot's own gives the robot's wall friction.
double surface_friction(const RobotBody& robot) {
  if (robot.robot_friction == robot.wall_friction || robot.robot_friction == 0) {
    return robot.wall_friction;
  }
  return robot.wall_friction * robot.wall_friction / robot.robot_friction;
}

Surroundings surroundings_of(const Arena& arena, const Robot& robot) {
  Surroundings surroundings = surroundings_of(arena);
  surroundings.friction = surface_friction(robot.body);
  return surroundings;
}

Ring proximity_ring_of(const Robot& robot) {
  Ring ring = ring_of(robot.proximity.rays_deg);
  ring.touches_walls = robot.proximity.reading == ProximityRing::Reading::Distance;
  return ring;
}

std::vector<MoverKind> kinds_of(const Arena& arena, const Robot& robot) {
  std::vector<MoverKind> kinds = {robot_kind(robot)};
  for (const MovableObject& object : arena.objects)
    kinds.push_back(object_kind(object, surface_friction(robot.body)));
  return kinds;
}

std::vector<Mover> movers_of(const Arena& arena, std::span<const Pose> starts,
                             const std::vector<MoverKind>& kinds) {
  std::vector<Mover> movers;
  for (const Pose& start : starts) {
    movers.push_back({.body = body_at(start), .set_point = {}, .kind = kinds.data()});
  }
  for (std::size_t i = 0; i < arena.objects.size(); ++i) {
    movers.push_back(
        {.body = body_at(arena.objects[i].start), .set_point = {}, .kind = &kinds[i + 1]});
  }
  return movers;
}

double largest_radius_of(const std::vector<MoverKind>& kinds) {
  double largest = 0;
  for (const MoverKind& kind : kinds)
    largest = std::max(largest, kind.form.radius_m);
  return largest;
}

}  // namespace

bool has_squares_alone(const Arena& arena, const Robot& robot) {
  return walls_of(arena).convex && robot_kind(robot) == rvr_kind() && arena.objects.empty();
}

bool has_discs_alone(const Arena& arena, const Robot& robot) {
  return std::holds_alternative<CircleOutline>(robot.body.outline) && arena.objects.empty() &&
         !is_rvr(robot);
}

namespace {

std::unique_ptr<ContactSolver> solver_of(ContactModel contacts, const Arena& arena,
                                         const Robot& robot, const Surroundings& surroundings) {
  if (contacts == ContactModel::Exact && has_discs_alone(arena, robot)) {
    return make_disc_solver(surroundings, robot.body.robot_friction, robot.body.wall_friction);
  }
  return make_contact_solver(contacts, has_squares_alone(arena, robot), surroundings);
}

}  // namespace

World::World(const Arena& arena, const Robot& robot, std::span<const Pose> starts,
             ContactModel contacts)
    : robot_(robot),
      proximity_ring_(proximity_ring_of(robot)),
      light_ring_(robot.light.angles_deg.empty() ? proximity_ring_
                                                 : ring_of(robot.light.angles_deg)),
      surroundings_(surroundings_of(arena, robot)),
      robots_(static_cast<int>(starts.size())),
      kinds_(kinds_of(arena, robot)),
      movers_(movers_of(arena, starts, kinds_)),
      squares_(has_squares_alone(arena, robot)),
      plain_(squares_ && arena.obstacles.empty()),
      largest_radius_m_(largest_radius_of(kinds_)),
      places_(movers_.size()),
      reach_(surroundings_, movers_.size(), largest_radius_m_),
      solver_(solver_of(contacts, arena, robot, surroundings_)) {
  places_.update(movers_);
}

void World::advance(int sub_steps) {
  const std::span<const Island> islands = reach_.find(
      {.movers = movers_, .places = places_, .speed_limit_mps = speed_limit_mps_}, sub_steps);
  solver_->advance(movers_, islands, sub_steps);
  for (std::size_t i = 0; i < movers_.size(); ++i) {
    Mover& mover = movers_[i];
    if (islands.empty() || reach_.is_free(static_cast<int>(i))) {
      advance_freely(mover.body, mover.set_point, sub_steps, mover.dynamics());
    }
  }
  for (const Island& island : islands)
    take_note(island, sub_steps);
  places_.update(movers_);
}

void World::take_note(const Island& island, int sub_steps) {
  solved_sub_steps_ += static_cast<long>(island.movers.size()) * sub_steps;
  for (const int mover : island.movers) {
    const Body& now = body(mover);
    // A push by a spinning corner may be faster than any drive.
    speed_limit_mps_ = std::max(speed_limit_mps_, std::sqrt(now.vx * now.vx + now.vy * now.vy));
  }
}

}  // namespace swarmsmith
