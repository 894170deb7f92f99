#include "sim/engine/internal/crossing.h"

#include <algorithm>
#include <cmath>

namespace swarmsmith {
namespace {

constexpr Stretch kNone = {.from = 1, .to = 0};

Stretch stretch_in_circle(double radius_m, Point origin, Point along) {
  // |origin + t along|^2 <= r^2.
  const double a = along.x * along.x + along.y * along.y;
  const double b = origin.x * along.x + origin.y * along.y;
  const double c = origin.x * origin.x + origin.y * origin.y - radius_m * radius_m;
  if (a == 0) return c <= 0 ? Stretch{} : kNone;
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return kNone;
  const double root = std::sqrt(discriminant);
  return {.from = (-b - root) / a, .to = (-b + root) / a};
}

}  // namespace

void Stretch::keep(double value, double slope) {
  if (slope > 0) {
    to = std::min(to, -value / slope);
  } else if (slope < 0) {
    from = std::max(from, -value / slope);
  } else if (value > 0) {
    *this = kNone;
  }
}

Stretch stretch_in(const Form& form, const Body& at, Point origin, Point along) {
  // All coordinates are in the solid's own frame.
  const double dx = origin.x - at.x;
  const double dy = origin.y - at.y;
  const Point start = {at.cos * dx + at.sin * dy, at.cos * dy - at.sin * dx};
  const Point step = {at.cos * along.x + at.sin * along.y, at.cos * along.y - at.sin * along.x};
  if (form.is_circle()) return stretch_in_circle(form.radius_m, start, step);
  Stretch stretch;
  const std::size_t n = form.corners.size();
  for (std::size_t i = 0; i < n && !stretch.empty(); ++i) {
    const Point from = form.corners[i];
    const Point to = form.corners[(i + 1) % n];
    const double nx = to.y - from.y;  // outward, since corners run counter-clockwise
    const double ny = from.x - to.x;
    stretch.keep(nx * (start.x - from.x) + ny * (start.y - from.y), nx * step.x + ny * step.y);
  }
  return stretch;
}

}  // namespace swarmsmith
