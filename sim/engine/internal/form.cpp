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

/// Integral of sqrt(height^2 + u^2) over u from 0 to `along`, times the height. This is three times
/// the integral of the distance from the origin over the right triangle with this height whose far
/// side has the length `along`.
double distance_integral(double height, double along) {
  const double slope = std::fabs(along) / height;
  const double arsinh = log(slope + std::sqrt(1 + slope * slope));
  const double length = hypot(height, along);
  return std::copysign(height * (std::fabs(along) * length + height * height * arsinh) / 2, along);
}

Form polygon(std::vector<Point> corners, double height_m) {
  Form form{.corners = std::move(corners),
            .radius_m = 0,
            .inradius_m = std::numeric_limits<double>::infinity(),
            .height_m = height_m};
  double area = 0;
  for (std::size_t i = 0; i < form.corners.size(); ++i) {
    const Point from = form.corners[i];
    const Point to = form.corners[(i + 1) % form.corners.size()];
    const double dx = to.x - from.x;
    const double dy = to.y - from.y;
    const double length = hypot(dx, dy);
    const double depth = depth_of_origin(from, to);
    form.radius_m = std::max(form.radius_m, hypot(from.x, from.y));
    form.inradius_m = std::min(form.inradius_m, depth);
    form.normals.push_back({dy / length, -dx / length});
    // The triangle between the origin and this side.
    const double twice_area = from.x * to.y - from.y * to.x;
    area += twice_area / 2;
    form.mean_radius2_m2 += twice_area / 12 *
                            (from.x * from.x + from.x * to.x + to.x * to.x + from.y * from.y +
                             from.y * to.y + to.y * to.y);
    if (depth == 0) continue;
    form.mean_radius_m += (distance_integral(depth, (to.x * dx + to.y * dy) / length) -
                           distance_integral(depth, (from.x * dx + from.y * dy) / length)) /
                          3;
  }
  form.mean_radius_m /= area;
  form.mean_radius2_m2 /= area;
  return form;
}

}  // namespace

Form form_of(const Outline& outline, double height_m) {
  return std::visit(
      Overloaded{[&](const CircleOutline& circle) -> Form {
                   return {.corners = {},
                           .radius_m = circle.radius_m,
                           .inradius_m = circle.radius_m,
                           .height_m = height_m,
                           .mean_radius_m = circle.radius_m * 2 / 3,
                           .mean_radius2_m2 = circle.radius_m * circle.radius_m / 2};
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

const Form& rvr_form() {
  static const Form form = form_of(BoxOutline{kBodySide_m, kBodySide_m}, kBodyHeight_m);
  return form;
}

}  // namespace swarmsmith
