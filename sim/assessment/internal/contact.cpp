#include "sim/assessment/internal/contact.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "base/math.h"

namespace swarmsmith::assessment {
namespace {

/// The widest gap between a face of `a` and all of `b` along the face's normal.
double gap_before_faces(const Footprint& a, const Footprint& b) {
  const auto corners = a.corners();
  double widest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point& from = corners[i];
    const Point& to = corners[(i + 1) % corners.size()];
    const double length = hypot(to.x - from.x, to.y - from.y);
    const Point out = {(to.y - from.y) / length, (from.x - to.x) / length};
    widest = std::max(widest, b.along(out.x, out.y).least - (from.x * out.x + from.y * out.y));
  }
  return widest;
}

}  // namespace

double body_gap(const Footprint& a, const Footprint& b) {
  if (a.corners().empty() && b.corners().empty()) {
    return hypot(b.centre().x - a.centre().x, b.centre().y - a.centre().y) - a.radius_m() -
           b.radius_m();
  }
  return std::max(gap_before_faces(a, b), gap_before_faces(b, a));
}

double wall_gap(const Footprint& robot, const Wall& wall) {
  const double along_x = wall.to.x - wall.from.x;
  const double along_y = wall.to.y - wall.from.y;
  const double length = hypot(along_x, along_y);
  const Point inward = {-along_y / length, along_x / length};
  return robot.along(inward.x, inward.y).least - (wall.from.x * inward.x + wall.from.y * inward.y);
}

bool any_contact(const Outline& outline, std::span<const Pose> robots, const Arena& arena) {
  std::vector<Footprint> bodies;
  for (const Pose& pose : robots)
    bodies.emplace_back(outline, pose);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t j = i + 1; j < bodies.size(); ++j) {
      if (body_gap(bodies[i], bodies[j]) <= kContactGap_m) return true;
    }
    for (const Wall& wall : arena.walls) {
      if (wall_gap(bodies[i], wall) <= kContactGap_m) return true;
    }
  }
  return false;
}

}  // namespace swarmsmith::assessment
