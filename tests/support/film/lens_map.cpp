#include "tests/support/film/lens_map.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace swarmsmith::film {

LensMap lens_map_of(const CameraModel& camera) {
  LensMap map;
  map.size = camera.size;
  std::vector<ImagePoint> row(static_cast<std::size_t>(camera.size.width));
  map.rays.reserve(row.size() * static_cast<std::size_t>(camera.size.height));
  for (int v = 0; v < camera.size.height; ++v) {
    for (int u = 0; u < camera.size.width; ++u)
      row[static_cast<std::size_t>(u)] = {static_cast<double>(u), static_cast<double>(v)};
    const std::vector<Ray> rays = rays_of(camera, row);
    map.rays.insert(map.rays.end(), rays.begin(), rays.end());
  }
  return map;
}

FloorMap::FloorMap(const LensMap& lens, const CameraPlace& place)
    : size_(lens.size), camera_(place.centre()) {
  spots_.reserve(lens.rays.size());
  const auto& r = place.rotation;
  for (const Ray& ray : lens.rays) {
    const double x = r[0] * ray.x + r[3] * ray.y + r[6];
    const double y = r[1] * ray.x + r[4] * ray.y + r[7];
    const double z = r[2] * ray.x + r[5] * ray.y + r[8];
    if (z >= 0) throw std::invalid_argument("the camera sees above the horizon");
    const double s = -camera_.z / z;
    spots_.push_back(
        {static_cast<float>(camera_.x + s * x), static_cast<float>(camera_.y + s * y)});
  }
}

Footprint FloorMap::at(int u, int v) const {
  const int left = std::max(u - 1, 0);
  const int right = std::min(u + 1, size_.width - 1);
  const int up = std::max(v - 1, 0);
  const int down = std::min(v + 1, size_.height - 1);
  const Spot& here = spot(u, v);
  const Spot& a = spot(left, v);
  const Spot& b = spot(right, v);
  const Spot& c = spot(u, up);
  const Spot& d = spot(u, down);
  const auto across = static_cast<float>(right - left);
  const auto along = static_cast<float>(down - up);
  return {here.x,
          here.y,
          (b.x - a.x) / across,
          (b.y - a.y) / across,
          (d.x - c.x) / along,
          (d.y - c.y) / along};
}

}  // namespace swarmsmith::film
