#include "sim/engine/internal/sight.h"

#include <algorithm>
#include <cmath>

#include "sim/engine/internal/crossing.h"

namespace swarmsmith {
namespace {

/// So many movers are tried one by one, without a search for near ones.
constexpr int kFew = 64;

/// Whether the segment from one point to another crosses the face of the wall.
bool meets_face(const WallPlane& wall, Point from, Point to) {
  const double depth = wall.depth_of(from.x, from.y);
  const double depth_step = wall.depth_of(to.x, to.y) - depth;
  const double along = wall.along(from.x, from.y);
  const double along_step = wall.along(to.x, to.y) - along;
  Stretch stretch;
  stretch.keep(-1, 1);
  stretch.keep(0, -1);
  stretch.keep(depth, depth_step);
  stretch.keep(-depth, -depth_step);
  stretch.keep(-along, -along_step);
  stretch.keep(along - wall.length_m, along_step);
  return !stretch.empty();
}

bool meets_solid(const Form& form, const Body& at, Point from, Point along) {
  Stretch stretch = stretch_in(form, at, from, along);
  stretch.keep(-1, 1);
  stretch.keep(0, -1);
  return !stretch.empty();
}

}  // namespace

bool can_hide(const Arena& arena, const Robot& robot) {
  const double height_m = robot.neighbours.height_m;
  const auto is_high = [&](const auto& solid) { return solid.height_m >= height_m; };
  return robot.body.height_m >= height_m ||
         (arena.wall_height_m >= height_m && !walls_of(arena).convex) ||
         std::ranges::any_of(arena.obstacles, is_high) ||
         std::ranges::any_of(arena.objects, is_high);
}

Sight::Sight(const World& world, double wall_height_m)
    : world_(&world),
      height_m_(world.robot().neighbours.height_m),
      walls_hide_(!world.walls().convex && wall_height_m >= height_m_),
      obstacles_hide_(std::ranges::any_of(
          world.obstacles(),
          [&](const FixedSolid& solid) { return solid.form.height_m >= height_m_; })),
      movers_hide_(false) {
  for (int mover = 0; mover < world.movers(); ++mover)
    movers_hide_ = movers_hide_ || world.form(mover).height_m >= height_m_;
  clear_ = !walls_hide_ && !obstacles_hide_ && !movers_hide_;
}

bool Sight::is_hidden(int robot, int other, std::vector<int>& room) const {
  if (clear_) return false;
  const Body& self = world_->body(robot);
  const Body& far = world_->body(other);
  const Point from = {self.x, self.y};
  const Point along = {far.x - self.x, far.y - self.y};
  if (walls_hide_) {
    for (const WallPlane& wall : world_->walls().planes) {
      if (meets_face(wall, from, {far.x, far.y})) return true;
    }
  }
  if (obstacles_hide_) {
    for (const FixedSolid& solid : world_->obstacles()) {
      if (solid.form.height_m >= height_m_ && meets_solid(solid.form, solid.at, from, along)) {
        return true;
      }
    }
  }
  if (!movers_hide_) return false;
  // Most movers are so far from the line that even the largest one would not meet it.
  const double radius_m = world_->largest_radius_m();
  const double distance2 = world_->distance2(robot, other);
  const double beside2 = 1.000001 * radius_m * radius_m * distance2;
  const auto hides = [&](int third) {
    const Body& at = world_->body(third);
    const double beside = along.x * (at.y - from.y) - along.y * (at.x - from.x);
    return beside * beside <= beside2 && third != robot && third != other &&
           world_->form(third).height_m >= height_m_ &&
           meets_solid(world_->form(third), at, from, along);
  };
  if (world_->movers() <= kFew) {
    for (int third = 0; third < world_->movers(); ++third) {
      if (hides(third)) return true;
    }
    return false;
  }
  bool hidden = false;
  world_->visit_near(robot, std::sqrt(distance2) + radius_m, room,
                     [&](int third) { hidden = hidden || hides(third); });
  return hidden;
}

}  // namespace swarmsmith
