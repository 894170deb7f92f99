#include "sim/engine/internal/reach.h"

#include <algorithm>

#include "sim/engine/internal/motion.h"

namespace swarmsmith {
Reach::Reach(const Walls& walls, int robots)
    : walls_(&walls),
      parent_(static_cast<std::size_t>(robots)),
      margin_m_(parent_.size()),
      speed_mps_(parent_.size()),
      in_island_(parent_.size()),
      islands_(parent_.size()) {}

std::span<const Island> Reach::find(const Swarm& swarm, int sub_steps) {
  const double span_s = sub_steps * kSubStep_s;
  std::fill(in_island_.begin(), in_island_.end(), char{0});
  count_ = 0;
  const bool pairs = any_pair_near(swarm, span_s);
  if (!pairs && !any_wall_near(swarm, span_s)) return {};
  bound_motion(swarm, span_s);
  // A group that grew may be pushed further than its members drive, and reach more.
  while (pairs && join_pairs(swarm))
    widen_groups(span_s);
  gather(swarm);
  return {islands_.data(), count_};
}

bool Reach::any_pair_near(const Swarm& swarm, double span_s) const {
  const double reach = 2 * (kCornerRadius_m + swarm.speed_limit_mps * span_s);
  const std::size_t n = swarm.bodies.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      if (swarm.distances2[i * n + j] < reach * reach) return true;
    }
  }
  return false;
}

bool Reach::any_wall_near(const Swarm& swarm, double span_s) const {
  const double clear = walls_->clear_radius_m - kCornerRadius_m - swarm.speed_limit_mps * span_s;
  return std::any_of(swarm.bodies.begin(), swarm.bodies.end(), [&](const Body& body) {
    return clear <= 0 || body.x * body.x + body.y * body.y >= clear * clear;
  });
}

void Reach::bound_motion(const Swarm& swarm, double span_s) {
  for (std::size_t i = 0; i < parent_.size(); ++i) {
    parent_[i] = static_cast<int>(i);
    speed_mps_[i] = surface_speed(swarm.bodies[i], swarm.set_points[i]);
    margin_m_[i] = speed_mps_[i] * span_s;
  }
}

int Reach::root(int robot) const {
  while (parent_[static_cast<std::size_t>(robot)] != robot) {
    robot = parent_[static_cast<std::size_t>(robot)];
  }
  return robot;
}

bool Reach::join_pairs(const Swarm& swarm) {
  bool joined = false;
  const std::size_t n = swarm.bodies.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const double margin = margin_m_[i] + margin_m_[j];
      const double circles = 2 * kCornerRadius_m + margin;
      if (swarm.distances2[i * n + j] >= circles * circles) continue;
      const int a = root(static_cast<int>(i));
      const int b = root(static_cast<int>(j));
      if (a == b || gap_between(swarm.bodies[i], swarm.bodies[j]) > margin) continue;
      parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
      joined = true;
    }
  }
  return joined;
}

void Reach::widen_groups(double span_s) {
  // An inelastic push makes nothing faster than the fastest point that pushes; off centre it may
  // add spin, which a factor of two covers.
  for (std::size_t i = 0; i < parent_.size(); ++i) {
    const auto group = static_cast<std::size_t>(root(static_cast<int>(i)));
    speed_mps_[group] = std::max(speed_mps_[group], speed_mps_[i]);
  }
  for (std::size_t i = 0; i < parent_.size(); ++i) {
    const auto group = static_cast<std::size_t>(root(static_cast<int>(i)));
    bool alone = group == i;
    for (std::size_t j = 0; alone && j < parent_.size(); ++j) {
      alone = j == i || root(static_cast<int>(j)) != static_cast<int>(i);
    }
    if (!alone) margin_m_[i] = 2 * speed_mps_[group] * span_s;
  }
}

bool Reach::wall_in_reach(const Body& body, const WallPlane& wall, double margin_m) const {
  const double depth = wall.depth_of(body.x, body.y);
  if (depth > kCornerRadius_m + margin_m) return false;
  if (!walls_->convex) {
    const double along = wall.along(body.x, body.y);
    const double beyond = kCornerRadius_m + margin_m;
    if (depth < -beyond || along < -beyond || along > wall.length_m + beyond) return false;
  }
  return gap_to(body, wall) <= margin_m;
}

void Reach::add_walls(const Swarm& swarm, Island& island) const {
  for (const int robot : island.robots) {
    const auto i = static_cast<std::size_t>(robot);
    const Body& body = swarm.bodies[i];
    const double clear = walls_->clear_radius_m - kCornerRadius_m - margin_m_[i];
    if (clear > 0 && body.x * body.x + body.y * body.y < clear * clear) continue;
    for (std::size_t w = 0; w < walls_->planes.size(); ++w) {
      if (!wall_in_reach(body, walls_->planes[w], margin_m_[i])) continue;
      const int wall = static_cast<int>(w);
      const auto place = std::lower_bound(island.walls.begin(), island.walls.end(), wall);
      if (place == island.walls.end() || *place != wall) island.walls.insert(place, wall);
    }
  }
}

void Reach::gather(const Swarm& swarm) {
  const int n = static_cast<int>(parent_.size());
  for (int first = 0; first < n; ++first) {
    if (root(first) != first) continue;
    Island& island = islands_[count_];
    island.robots.clear();
    island.walls.clear();
    for (int i = first; i < n; ++i) {
      if (root(i) == first) island.robots.push_back(i);
    }
    add_walls(swarm, island);
    if (island.robots.size() < 2 && island.walls.empty()) continue;
    for (const int robot : island.robots)
      in_island_[static_cast<std::size_t>(robot)] = 1;
    ++count_;
  }
}

}  // namespace swarmsmith
