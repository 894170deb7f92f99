#include "sim/assessment/internal/contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/math.h"
#include "sim/robot/rvr.h"

namespace swarmsmith::assessment {
namespace {

/// Half the extent of the robot's square along a unit vector.
double half_extent(const SinCos& heading, Point along) {
  return 0.5 * kBodySide_m *
         (std::fabs(heading.cos * along.x + heading.sin * along.y) +
          std::fabs(heading.cos * along.y - heading.sin * along.x));
}

}  // namespace

double body_gap(const Pose& a, const Pose& b) {
  const SinCos heading_a = sin_cos(a.theta);
  const SinCos heading_b = sin_cos(b.theta);
  const std::array<Point, 4> axes = {{{heading_a.cos, heading_a.sin},
                                      {-heading_a.sin, heading_a.cos},
                                      {heading_b.cos, heading_b.sin},
                                      {-heading_b.sin, heading_b.cos}}};
  double widest = -std::numeric_limits<double>::infinity();
  for (const Point& axis : axes) {
    const double distance = std::fabs((b.x - a.x) * axis.x + (b.y - a.y) * axis.y);
    widest =
        std::max(widest, distance - half_extent(heading_a, axis) - half_extent(heading_b, axis));
  }
  return widest;
}

double wall_gap(const Pose& robot, const Wall& wall) {
  const double along_x = wall.to.x - wall.from.x;
  const double along_y = wall.to.y - wall.from.y;
  const double length = hypot(along_x, along_y);
  const Point inward = {-along_y / length, along_x / length};
  const double distance = (robot.x - wall.from.x) * inward.x + (robot.y - wall.from.y) * inward.y;
  return distance - half_extent(sin_cos(robot.theta), inward);
}

bool any_contact(std::span<const Pose> robots, const Arena& arena) {
  for (std::size_t i = 0; i < robots.size(); ++i) {
    for (std::size_t j = i + 1; j < robots.size(); ++j) {
      if (body_gap(robots[i], robots[j]) <= kContactGap_m) return true;
    }
    for (const Wall& wall : arena.walls) {
      if (wall_gap(robots[i], wall) <= kContactGap_m) return true;
    }
  }
  return false;
}

}  // namespace swarmsmith::assessment
