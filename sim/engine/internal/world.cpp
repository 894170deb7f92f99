#include "sim/engine/internal/world.h"

#include <algorithm>
#include <cmath>

#include "sim/engine/internal/motion.h"

namespace swarmsmith {
namespace {

std::vector<MoverKind> kinds_of(const Arena& arena, const Outline& robot) {
  std::vector<MoverKind> kinds = {robot_kind(robot)};
  for (const MovableObject& object : arena.objects)
    kinds.push_back(object_kind(object));
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

bool has_squares_alone(const Arena& arena, const Outline& robot) {
  return walls_of(arena).convex && robot_kind(robot).form.is_rvr && arena.objects.empty();
}

World::World(const Arena& arena, const Outline& robot, std::span<const Pose> starts,
             ContactModel contacts)
    : surroundings_(surroundings_of(arena)),
      robots_(static_cast<int>(starts.size())),
      kinds_(kinds_of(arena, robot)),
      movers_(movers_of(arena, starts, kinds_)),
      squares_(has_squares_alone(arena, robot)),
      plain_(squares_ && arena.obstacles.empty()),
      largest_radius_m_(largest_radius_of(kinds_)),
      places_(movers_.size()),
      reach_(surroundings_, movers_.size(), largest_radius_m_),
      solver_(make_contact_solver(contacts, squares_, surroundings_)) {
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
