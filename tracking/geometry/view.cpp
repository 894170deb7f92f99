#include "tracking/geometry/view.h"

namespace swarmsmith {
namespace {

/// The transposed rotation times a vector.
Point3 turned_back(const std::array<double, 9>& r, const Point3& p) {
  return {r[0] * p.x + r[3] * p.y + r[6] * p.z, r[1] * p.x + r[4] * p.y + r[7] * p.z,
          r[2] * p.x + r[5] * p.y + r[8] * p.z};
}

}  // namespace

Point3 CameraPlace::centre() const {
  const Point3 back = turned_back(rotation, translation);
  return {-back.x, -back.y, -back.z};
}

Point3 CameraPlace::seen_from_camera(const Point3& world) const {
  const auto& r = rotation;
  return {r[0] * world.x + r[1] * world.y + r[2] * world.z + translation.x,
          r[3] * world.x + r[4] * world.y + r[5] * world.z + translation.y,
          r[6] * world.x + r[7] * world.y + r[8] * world.z + translation.z};
}

std::vector<Point> on_plane(const View& view, std::span<const ImagePoint> points, double height_m) {
  const Point3 centre = view.place.centre();
  std::vector<Point> cuts;
  cuts.reserve(points.size());
  for (const Ray& ray : rays_of(view.camera, points)) {
    const Point3 direction = turned_back(view.place.rotation, {ray.x, ray.y, 1});
    const double length = (height_m - centre.z) / direction.z;
    cuts.push_back({centre.x + length * direction.x, centre.y + length * direction.y});
  }
  return cuts;
}

ImagePoint image_of(const View& view, const Point3& world) {
  return image_of(view.camera, view.place.seen_from_camera(world));
}

}  // namespace swarmsmith
