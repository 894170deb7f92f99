#include "sim/engine/internal/world.h"

#include <algorithm>
#include <cmath>

#include "sim/engine/internal/motion.h"

namespace swarmsmith {

World::World(const Arena& arena, const Outline& robot, std::span<const Pose> starts,
             ContactModel contacts)
    : walls_(walls_of(arena)),
      robots_(static_cast<int>(starts.size())),
      forms_{form_of(robot, kBodyHeight_m)},
      plain_(walls_.convex && forms_[0].is_rvr && arena.obstacles.empty() && arena.objects.empty()),
      set_points_(starts.size() + arena.objects.size()),
      distances2_(set_points_.size() * set_points_.size()),
      reach_(walls_, static_cast<int>(set_points_.size())),
      solver_(make_contact_solver(contacts, plain_)) {
  for (const Pose& start : starts)
    bodies_.push_back(body_at(start));
  for (const MovableObject& object : arena.objects) {
    bodies_.push_back(body_at(object.start));
    forms_.push_back(form_of(object.outline, object.height_m));
  }
  for (const Obstacle& obstacle : arena.obstacles) {
    obstacles_.push_back({form_of(obstacle.outline, obstacle.height_m), body_at(obstacle.pose)});
  }
  measure_distances();
}

void World::command(int robot, const Command& command) {
  const auto i = static_cast<std::size_t>(robot);
  set_points_[i] = set_point_of(command, bodies_[i]);
  speed_limit_mps_ = std::max(speed_limit_mps_,
                              std::max(std::fabs(command.left_mps), std::fabs(command.right_mps)));
}

void World::advance(int sub_steps) {
  const std::span<const Island> islands = reach_.find({.bodies = bodies_,
                                                       .set_points = set_points_,
                                                       .distances2 = distances2_,
                                                       .speed_limit_mps = speed_limit_mps_},
                                                      sub_steps);
  for (const Island& island : islands)
    advance_island(island, sub_steps);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (islands.empty() || reach_.is_free(static_cast<int>(i))) {
      advance_freely(bodies_[i], set_points_[i], sub_steps);
    }
  }
  measure_distances();
}

void World::advance_island(const Island& island, int sub_steps) {
  members_.clear();
  near_walls_.clear();
  for (const int robot : island.robots) {
    const auto i = static_cast<std::size_t>(robot);
    members_.push_back({bodies_[i], set_points_[i]});
  }
  for (const int wall : island.walls) {
    near_walls_.push_back(walls_.planes[static_cast<std::size_t>(wall)]);
  }
  solver_->advance(members_, near_walls_, sub_steps);
  solved_sub_steps_ += static_cast<long>(members_.size()) * sub_steps;
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const Body& body = members_[m].body;
    bodies_[static_cast<std::size_t>(island.robots[m])] = body;
    // A push by a spinning corner may be faster than any drive.
    speed_limit_mps_ = std::max(speed_limit_mps_, std::sqrt(body.vx * body.vx + body.vy * body.vy));
  }
}

void World::measure_distances() {
  const std::size_t n = bodies_.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const double dx = bodies_[j].x - bodies_[i].x;
      const double dy = bodies_[j].y - bodies_[i].y;
      distances2_[i * n + j] = distances2_[j * n + i] = dx * dx + dy * dy;
    }
  }
}

}  // namespace swarmsmith
