#include "sim/engine/internal/form.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math.h"
#include "base/overloaded.h"

namespace swarmsmith {
namespace {

/// Distance of the origin from the line through two corners.
double depth_of_origin(Point from, Point to) {
  const double dx = to.x - from.x;
  const double dy = to.y - from.y;
  return std::fabs(from.x * dy - from.y * dx) / hypot(dx, dy);
}

Form polygon(std::vector<Point> corners, double height_m) {
  Form form{.corners = std::move(corners),
            .radius_m = 0,
            .inradius_m = std::numeric_limits<double>::infinity(),
            .height_m = height_m};
  for (std::size_t i = 0; i < form.corners.size(); ++i) {
    const Point from = form.corners[i];
    const Point to = form.corners[(i + 1) % form.corners.size()];
    form.radius_m = std::max(form.radius_m, hypot(from.x, from.y));
    form.inradius_m = std::min(form.inradius_m, depth_of_origin(from, to));
  }
  return form;
}

}  // namespace

Form form_of(const Outline& outline, double height_m) {
  return std::visit(
      Overloaded{[&](const CircleOutline& circle) -> Form {
                   return {.corners = {},
                           .radius_m = circle.radius_m,
                           .inradius_m = circle.radius_m,
                           .height_m = height_m};
                 },
                 [&](const BoxOutline& box) {
                   const double x = box.length_m / 2;
                   const double y = box.width_m / 2;
                   Form form = polygon({{x, y}, {-x, y}, {-x, -y}, {x, -y}}, height_m);
                   form.is_rvr = box.length_m == kBodySide_m && box.width_m == kBodySide_m;
                   return form;
                 },
                 [&](const PolygonOutline& any) { return polygon(any.corners, height_m); }},
      outline);
}

}  // namespace swarmsmith
