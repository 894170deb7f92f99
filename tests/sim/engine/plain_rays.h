#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "sim/engine/internal/world.h"

namespace swarmsmith {

/// Rays the plain way: each against everything, for tests of the quick ways.

/// A hexagon with a notch, so that a wall may hide another one.
inline Arena notched_arena() {
  Arena arena;
  const std::vector<Point> corners = {{1, 0},  {0.6, 0.9},  {0, 0.3},
                                      {-1, 1}, {-1.2, 0.0}, {-0.2, -1}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    arena.walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
  }
  return arena;
}

/// Obstacles and objects of all kinds of outline, off the centre.
inline void furnish(Arena& arena) {
  arena.obstacles = {
      {.outline = PolygonOutline{{{0.1, 0}, {-0.05, 0.08}, {-0.05, -0.08}}}, .pose = {0.5, 0.1, 2}},
      {.outline = CircleOutline{0.1}, .pose = {-0.55, -0.3, 0}}};
  arena.objects = {{.outline = BoxOutline{0.3, 0.1}, .start = {-0.6, 0.35, 0.7}},
                   {.outline = CircleOutline{0.06}, .start = {0.1, -0.6, 0}}};
}

/// Distance along a ray to a segment; infinity when it is missed.
inline double to_segment(Point start, Point direction, Point from, Point to) {
  const double ex = to.x - from.x;
  const double ey = to.y - from.y;
  const double cross = direction.x * ey - direction.y * ex;
  const double fx = from.x - start.x;
  const double fy = from.y - start.y;
  const double t = (fx * ey - fy * ex) / cross;
  const double u = (fx * direction.y - fy * direction.x) / cross;
  return cross != 0 && t >= 0 && u >= 0 && u <= 1 ? t : std::numeric_limits<double>::infinity();
}

/// Distance along a ray that starts outside to a circle; infinity when it is missed.
inline double to_circle(Point start, Point direction, Point centre, double radius) {
  const double cx = centre.x - start.x;
  const double cy = centre.y - start.y;
  const double aside = direction.x * cy - direction.y * cx;
  const double ahead = direction.x * cx + direction.y * cy;
  return std::fabs(aside) <= radius && ahead > 0
             ? ahead - std::sqrt(radius * radius - aside * aside)
             : std::numeric_limits<double>::infinity();
}

inline std::vector<Wall> sides_of(const Form& form, const Body& at) {
  std::vector<Wall> sides;
  const auto placed = [&](Point p) {
    return Point{at.x + at.cos * p.x - at.sin * p.y, at.y + at.sin * p.x + at.cos * p.y};
  };
  for (std::size_t i = 0; i < form.corners.size(); ++i) {
    sides.push_back({placed(form.corners[i]), placed(form.corners[(i + 1) % form.corners.size()])});
  }
  return sides;
}

inline double to_solid(Point start, Point direction, const Form& form, const Body& at) {
  if (form.is_circle()) return to_circle(start, direction, {at.x, at.y}, form.radius_m);
  double nearest = std::numeric_limits<double>::infinity();
  for (const Wall& side : sides_of(form, at))
    nearest = std::fmin(nearest, to_segment(start, direction, side.from, side.to));
  return nearest;
}

/// Distance to the nearest wall, other robot, obstacle or object of a world.
inline double to_anything(Point start, Point direction, const Arena& arena, const World& world,
                          int robot) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Wall& wall : arena.walls)
    nearest = std::fmin(nearest, to_segment(start, direction, wall.from, wall.to));
  for (int other = 0; other < world.movers(); ++other) {
    if (other == robot) continue;
    nearest = std::fmin(nearest, to_solid(start, direction, world.form(other), world.body(other)));
  }
  for (const FixedSolid& solid : world.obstacles())
    nearest = std::fmin(nearest, to_solid(start, direction, solid.form, solid.at));
  return nearest;
}

}  // namespace swarmsmith
