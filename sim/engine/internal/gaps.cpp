#include "sim/engine/internal/gaps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swarmsmith {

double extent_along(const Form& form, const Body& at, double x, double y) {
  if (form.is_circle()) return form.radius_m;
  const double own_x = x * at.cos + y * at.sin;
  const double own_y = y * at.cos - x * at.sin;
  double extent = -std::numeric_limits<double>::infinity();
  for (const Point& corner : form.corners)
    extent = std::max(extent, own_x * corner.x + own_y * corner.y);
  return extent;
}

namespace {

/// The widest gap along the normals of the first solid's sides; -infinity for a circle.
double gap_along_normals(const Form& form, const Body& at, const Form& other,
                         const Body& other_at) {
  double widest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < form.normals.size(); ++i) {
    const Point& normal = form.normals[i];
    const double x = normal.x * at.cos - normal.y * at.sin;
    const double y = normal.x * at.sin + normal.y * at.cos;
    const double own = normal.x * form.corners[i].x + normal.y * form.corners[i].y;
    const double apart = x * (other_at.x - at.x) + y * (other_at.y - at.y);
    widest = std::max(widest, apart - own - extent_along(other, other_at, -x, -y));
  }
  return widest;
}

}  // namespace

double gap_between(const Form& form, const Body& at, const Form& other, const Body& other_at) {
  if (form.is_rvr && other.is_rvr) return gap_between(at, other_at);
  if (form.is_circle() && other.is_circle()) {
    const double dx = other_at.x - at.x;
    const double dy = other_at.y - at.y;
    return std::sqrt(dx * dx + dy * dy) - form.radius_m - other.radius_m;
  }
  double gap = std::max(gap_along_normals(form, at, other, other_at),
                        gap_along_normals(other, other_at, form, at));
  if (form.is_circle() || other.is_circle()) {
    const double dx = other_at.x - at.x;
    const double dy = other_at.y - at.y;
    gap = std::max(gap, std::sqrt(dx * dx + dy * dy) - form.radius_m - other.radius_m);
  }
  return gap;
}

double gap_to(const Form& form, const Body& at, const WallPlane& wall) {
  const double depth = wall.depth_of(at.x, at.y);
  const double along = wall.along(at.x, at.y);
  if (form.is_circle()) {
    const double beyond = along - std::clamp(along, 0.0, wall.length_m);
    return std::sqrt(depth * depth + beyond * beyond) - form.radius_m;
  }
  const double in_front = depth - extent_along(form, at, wall.nx, wall.ny);
  const double behind = -depth - extent_along(form, at, -wall.nx, -wall.ny);
  double widest = std::max(in_front, behind);
  for (std::size_t i = 0; i < form.normals.size(); ++i) {
    const Point& normal = form.normals[i];
    const double x = normal.x * at.cos - normal.y * at.sin;
    const double y = normal.x * at.sin + normal.y * at.cos;
    const double own = normal.x * form.corners[i].x + normal.y * form.corners[i].y;
    const double from = x * (wall.from.x - at.x) + y * (wall.from.y - at.y);
    const double to = from + wall.length_m * (wall.nx * y - wall.ny * x);
    widest = std::max(widest, std::min(from, to) - own);
  }
  return widest;
}

}  // namespace swarmsmith
