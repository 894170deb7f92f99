#include "sim/mission/footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "base/assert.h"
#include "base/math.h"
#include "base/overloaded.h"

namespace swarmsmith {
namespace {

double distance(Point a, Point b) {
  return hypot(b.x - a.x, b.y - a.y);
}

/// Distance of a point from a segment.
double distance_to(Point from, Point to, Point point) {
  const double x = to.x - from.x;
  const double y = to.y - from.y;
  const double along = ((point.x - from.x) * x + (point.y - from.y) * y) / (x * x + y * y);
  const double nearest = std::clamp(along, 0.0, 1.0);
  return distance({from.x + nearest * x, from.y + nearest * y}, point);
}

bool circle_overlaps(const Footprint& circle, const Footprint& other) {
  if (other.corners().empty()) {
    return distance(circle.centre(), other.centre()) < circle.radius_m() + other.radius_m();
  }
  const auto corners = other.corners();
  bool is_left = true;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point from = corners[i];
    const Point to = corners[(i + 1) % corners.size()];
    if (distance_to(from, to, circle.centre()) < circle.radius_m()) return true;
    is_left = is_left && (to.x - from.x) * (circle.centre().y - from.y) >=
                             (to.y - from.y) * (circle.centre().x - from.x);
  }
  return is_left;
}

/// Extents that only touch have a gap, too: bodies may stand side by side.
bool gap_between(Footprint::Extent a, Footprint::Extent b) {
  return a.most <= b.least || b.most <= a.least;
}

/// Separating axis test: whether all of `b` lies beyond a side of `a`.
bool side_separates(const Footprint& a, const Footprint& b) {
  const auto corners = a.corners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point from = corners[i];
    const Point to = corners[(i + 1) % corners.size()];
    const double length = distance(from, to);
    const double x = (to.y - from.y) / length;
    const double y = -(to.x - from.x) / length;
    if (b.along(x, y).least >= from.x * x + from.y * y) return true;
  }
  return false;
}

}  // namespace

Footprint::Footprint(const Outline& outline, const Pose& pose) : centre_(pose.position()) {
  const SinCos heading = sin_cos(pose.theta);
  std::visit(Overloaded{[&](const CircleOutline& circle) { radius_m_ = circle.radius_m; },
                        [&](const BoxOutline& box) {
                          const double x = box.length_m / 2;
                          const double y = box.width_m / 2;
                          for (const Point own : {Point{x, y}, {-x, y}, {-x, -y}, {x, -y}})
                            add_corner(own, heading.cos, heading.sin);
                        },
                        [&](const PolygonOutline& polygon) {
                          for (const Point own : polygon.corners)
                            add_corner(own, heading.cos, heading.sin);
                        }},
             outline);
}

void Footprint::add_corner(Point own, double cos, double sin) {
  SWARMSMITH_ASSERT(count_ < corners_.size(), "an outline has at most 8 corners");
  corners_[count_++] = {centre_.x + own.x * cos - own.y * sin,
                        centre_.y + own.x * sin + own.y * cos};
}

Footprint::Extent Footprint::along(double x, double y) const {
  const double middle = centre_.x * x + centre_.y * y;
  if (count_ == 0) return {middle - radius_m_, middle + radius_m_};
  Extent extent{corners_[0].x * x + corners_[0].y * y, 0};
  extent.most = extent.least;
  for (std::size_t i = 1; i < count_; ++i) {
    const double at = corners_[i].x * x + corners_[i].y * y;
    extent.least = std::min(extent.least, at);
    extent.most = std::max(extent.most, at);
  }
  return extent;
}

double inradius_of(const Outline& outline) {
  const auto of_polygon = [](const PolygonOutline& polygon) {
    double least_m = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
      const Point from = polygon.corners[i];
      const Point to = polygon.corners[(i + 1) % polygon.corners.size()];
      least_m = std::min(least_m, std::fabs(from.x * to.y - from.y * to.x) / distance(from, to));
    }
    return least_m;
  };
  return std::visit(
      Overloaded{[](const CircleOutline& circle) { return circle.radius_m; },
                 [](const BoxOutline& box) { return std::min(box.length_m, box.width_m) / 2; },
                 of_polygon},
      outline);
}

double circumradius_of(const Outline& outline) {
  const auto of_polygon = [](const PolygonOutline& polygon) {
    double most_m = 0;
    for (const Point& corner : polygon.corners)
      most_m = std::max(most_m, hypot(corner.x, corner.y));
    return most_m;
  };
  return std::visit(
      Overloaded{[](const CircleOutline& circle) { return circle.radius_m; },
                 [](const BoxOutline& box) { return hypot(box.length_m, box.width_m) / 2; },
                 of_polygon},
      outline);
}

bool overlap(const Footprint& a, const Footprint& b) {
  if (a.corners().empty()) return circle_overlaps(a, b);
  if (b.corners().empty()) return circle_overlaps(b, a);
  return !side_separates(a, b) && !side_separates(b, a);
}

bool crosses(const Footprint& solid, const Wall& wall) {
  const double length = distance(wall.from, wall.to);
  const double x = (wall.to.x - wall.from.x) / length;
  const double y = (wall.to.y - wall.from.y) / length;
  // Perpendicular to the wall first: this test already excludes nearly all pairs of solids and
  // walls.
  const Footprint::Extent across = solid.along(-y, x);
  const double face = wall.from.y * x - wall.from.x * y;
  if (across.least >= face || across.most <= face) return false;
  if (solid.corners().empty()) {
    return distance_to(wall.from, wall.to, solid.centre()) < solid.radius_m();
  }
  const double begin = wall.from.x * x + wall.from.y * y;
  if (gap_between(solid.along(x, y), {begin, begin + length})) return false;
  const auto corners = solid.corners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point from = corners[i];
    const Point to = corners[(i + 1) % corners.size()];
    const double out_x = to.y - from.y;
    const double out_y = from.x - to.x;
    const double side = from.x * out_x + from.y * out_y;
    if (wall.from.x * out_x + wall.from.y * out_y >= side &&
        wall.to.x * out_x + wall.to.y * out_y >= side) {
      return false;
    }
  }
  return true;
}

}  // namespace swarmsmith
