#include "sim/engine/internal/reach.h"

#include <algorithm>

#include "sim/engine/internal/gaps.h"
#include "sim/engine/internal/motion.h"

namespace swarmsmith {
namespace {

/// An inelastic push makes nothing faster than the fastest point that pushes. Off centre it may add
/// spin; for convex outlines of uniform density a factor of two covers this.
constexpr double kPushed = 2;
/// Bound of the error of a solver in single precision, metres.
constexpr double kRounding_m = 1e-6;

double square(double x) {
  return x * x;
}

}  // namespace

Reach::Reach(const Surroundings& surroundings, std::size_t movers, double largest_radius_m)
    : surroundings_(&surroundings),
      largest_radius_m_(largest_radius_m),
      parent_(movers),
      in_group_(movers),
      island_(movers),
      margin_m_(movers),
      speed_mps_(movers),
      in_island_(movers),
      islands_(movers) {}

std::span<const Island> Reach::find(const Swarm& swarm, int sub_steps) {
  const double span_s = sub_steps * kSubStep_s;
  if (count_ > 0) std::fill(in_island_.begin(), in_island_.end(), char{0});
  count_ = 0;
  const bool pairs = any_pair_near(swarm, span_s);
  if (!pairs && !any_wall_near(swarm, span_s) && !any_obstacle_near(swarm, span_s)) return {};
  bound_motion(swarm, span_s);
  near_.clear();
  if (pairs) list_pairs(swarm, span_s);
  // A group that grew may be pushed farther than its members would drive, and so reach more.
  while (join_pairs(swarm))
    widen_groups(span_s);
  gather(swarm);
  return {islands_.data(), count_};
}

bool Reach::any_pair_near(const Swarm& swarm, double span_s) {
  const double reach = 2 * (largest_radius_m_ + swarm.speed_limit_mps * span_s + kRounding_m);
  return swarm.places.any_pair_near(swarm.movers, reach, room_);
}

bool Reach::any_wall_near(const Swarm& swarm, double span_s) const {
  const double clear = surroundings_->walls.clear_radius_m - largest_radius_m_ -
                       swarm.speed_limit_mps * span_s - kRounding_m;
  if (clear <= 0) return !swarm.movers.empty();
  bool any = false;
  for (const Mover& mover : swarm.movers)
    any |= square(mover.body.x) + square(mover.body.y) >= square(clear);
  return any;
}

bool Reach::any_obstacle_near(const Swarm& swarm, double span_s) const {
  const double margin = swarm.speed_limit_mps * span_s + kRounding_m;
  for (const FixedSolid& solid : surroundings_->obstacles) {
    for (const Mover& mover : swarm.movers) {
      const double reach = solid.form.radius_m + mover.form().radius_m + margin;
      if (square(mover.body.x - solid.at.x) + square(mover.body.y - solid.at.y) < square(reach)) {
        return true;
      }
    }
  }
  return false;
}

void Reach::bound_motion(const Swarm& swarm, double span_s) {
  for (const std::size_t i : grouped_)
    in_group_[i] = 0;
  grouped_.clear();
  for (std::size_t i = 0; i < parent_.size(); ++i) {
    const Mover& mover = swarm.movers[i];
    parent_[i] = i;
    speed_mps_[i] = surface_speed(mover.body, mover.set_point, mover.form().radius_m);
    margin_m_[i] = speed_mps_[i] * span_s + kRounding_m;
  }
}

void Reach::list_pairs(const Swarm& swarm, double span_s) {
  const double fastest = *std::max_element(speed_mps_.begin(), speed_mps_.end());
  const double reach = 2 * (largest_radius_m_ + kPushed * fastest * span_s + kRounding_m);
  for (std::size_t i = 0; i < swarm.movers.size(); ++i) {
    swarm.places.visit_near(swarm.movers, i, reach, i + 1, room_, [&](int other) {
      near_.push_back({i, static_cast<std::size_t>(other)});
    });
  }
}

std::size_t Reach::root(std::size_t mover) const {
  while (parent_[mover] != mover)
    mover = parent_[mover];
  return mover;
}

bool Reach::may_touch(const Swarm& swarm, const Pair& pair) const {
  const auto& [i, j] = pair;
  // Movers that rest against each other stay at rest.
  if (speed_mps_[i] == 0 && speed_mps_[j] == 0) return false;
  const Mover& a = swarm.movers[i];
  const Mover& b = swarm.movers[j];
  const double margin = margin_m_[i] + margin_m_[j];
  const double circles = a.form().radius_m + b.form().radius_m + margin;
  return distance2_of(a.body, b.body) < square(circles) &&
         gap_between(a.form(), a.body, b.form(), b.body) <= margin;
}

bool Reach::join_pairs(const Swarm& swarm) {
  const bool anew = grouped_.empty();
  bool joined = false;
  for (const Pair& pair : near_) {
    // A pair outside all groups reaches no farther than in the round before.
    if (!anew && !in_group_[pair.a] && !in_group_[pair.b]) continue;
    const std::size_t a = root(pair.a);
    const std::size_t b = root(pair.b);
    if (a == b || !may_touch(swarm, pair)) continue;
    parent_[std::max(a, b)] = std::min(a, b);
    for (const std::size_t i : {pair.a, pair.b}) {
      if (!in_group_[i]) grouped_.push_back(i);
      in_group_[i] = 1;
    }
    joined = true;
  }
  return joined;
}

void Reach::widen_groups(double span_s) {
  for (const std::size_t i : grouped_) {
    parent_[i] = root(i);
    speed_mps_[parent_[i]] = std::max(speed_mps_[parent_[i]], speed_mps_[i]);
  }
  for (const std::size_t i : grouped_) {
    speed_mps_[i] = speed_mps_[parent_[i]];
    margin_m_[i] = kPushed * speed_mps_[i] * span_s + kRounding_m;
  }
}

bool Reach::wall_in_reach(const Mover& mover, const WallPlane& wall, double margin_m) const {
  const double beyond = mover.form().radius_m + margin_m;
  if (wall.depth_of(mover.body.x, mover.body.y) > beyond) return false;
  if (surroundings_->walls.convex && mover.form().is_rvr) {
    return gap_to(mover.body, wall) <= margin_m;
  }
  return gap_to(mover.form(), mover.body, wall) <= margin_m;
}

void Reach::add_surroundings(const Swarm& swarm, std::size_t mover, Island& island) const {
  if (speed_mps_[mover] == 0) return;
  const int name = static_cast<int>(mover);
  const Mover& self = swarm.movers[mover];
  const double margin = margin_m_[mover];
  const std::vector<WallPlane>& planes = surroundings_->walls.planes;
  const double clear = surroundings_->walls.clear_radius_m - self.form().radius_m - margin;
  if (clear <= 0 || square(self.body.x) + square(self.body.y) >= square(clear)) {
    for (std::size_t w = 0; w < planes.size(); ++w) {
      if (wall_in_reach(self, planes[w], margin)) {
        island.walls.push_back({name, static_cast<int>(w)});
      }
    }
  }
  for (std::size_t o = 0; o < surroundings_->obstacles.size(); ++o) {
    const FixedSolid& solid = surroundings_->obstacles[o];
    const double circles = solid.form.radius_m + self.form().radius_m + margin;
    const double distance2 = square(self.body.x - solid.at.x) + square(self.body.y - solid.at.y);
    if (distance2 < square(circles) &&
        gap_between(self.form(), self.body, solid.form, solid.at) <= margin) {
      island.obstacles.push_back({name, static_cast<int>(o)});
    }
  }
}

void Reach::gather(const Swarm& swarm) {
  for (std::size_t i = 0; i < parent_.size(); ++i) {
    // The root is the smallest mover of its group (`join_pairs`), so it comes first and clears the
    // entry. Without contacts the entry is not counted, and the next root takes it.
    const std::size_t group = root(i);
    if (group == i) {
      island_[i] = count_;
      Island& island = islands_[count_];
      island.movers.clear();
      island.pairs.clear();
      island.walls.clear();
      island.obstacles.clear();
    }
    Island& island = islands_[island_[group]];
    add_surroundings(swarm, i, island);
    if (!in_group_[i] && island.walls.empty() && island.obstacles.empty()) continue;
    island.movers.push_back(static_cast<int>(i));
    in_island_[i] = 1;
    if (group == i) ++count_;
  }
  for (const Pair& pair : near_) {
    if (!in_group_[pair.a] || !in_group_[pair.b]) continue;
    const std::size_t group = root(pair.a);
    if (group == root(pair.b) && may_touch(swarm, pair)) {
      islands_[island_[group]].pairs.push_back(
          {static_cast<int>(pair.a), static_cast<int>(pair.b)});
    }
  }
}

}  // namespace swarmsmith
