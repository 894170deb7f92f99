#include "tests/support/film/scene.h"

#include <cmath>

namespace swarmsmith::film {
namespace {

Point3 cross(const Point3& a, const Point3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Point3 unit(const Point3& p) {
  const double length = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
  return {p.x / length, p.y / length, p.z / length};
}

}  // namespace

TagCorners corners_of_tag(const View& view, const Pose& tag, double edge_m, double height_m) {
  const double half = edge_m / 2;
  const std::array<Point, 4> model{{{-half, -half}, {half, -half}, {half, half}, {-half, half}}};
  const double c = std::cos(tag.theta);
  const double s = std::sin(tag.theta);
  TagCorners corners;
  for (std::size_t i = 0; i < model.size(); ++i) {
    corners[i] = image_of(view, {tag.x + c * model[i].x - s * model[i].y,
                                 tag.y + s * model[i].x + c * model[i].y, height_m});
  }
  return corners;
}

CameraPlace looking_at(const Point3& centre, Point target, double roll_rad) {
  const Point3 forward = unit({target.x - centre.x, target.y - centre.y, -centre.z});
  const Point3 right = unit(cross(forward, {0, 1, 0}));
  const Point3 down = cross(forward, right);
  const double c = std::cos(roll_rad);
  const double s = std::sin(roll_rad);
  const Point3 x{c * right.x + s * down.x, c * right.y + s * down.y, c * right.z + s * down.z};
  const Point3 y{c * down.x - s * right.x, c * down.y - s * right.y, c * down.z - s * right.z};
  CameraPlace place{{x.x, x.y, x.z, y.x, y.y, y.z, forward.x, forward.y, forward.z}, {}};
  const Point3 moved = place.seen_from_camera(centre);
  place.translation = {-moved.x, -moved.y, -moved.z};
  return place;
}

}  // namespace swarmsmith::film
