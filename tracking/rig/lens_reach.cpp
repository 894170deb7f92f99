#include "tracking/rig/lens_reach.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math.h"

namespace swarmsmith {
namespace {

/// As a share of the picture's larger side; a lens hardly changes over this distance.
constexpr double kMargin = 0.05;
constexpr double kGrid_m = 0.05;

/// The distance of a point from a hull, negative inside. The corners of the hull may be in either
/// direction of rotation.
double outside_by(const std::vector<ImagePoint>& hull, const ImagePoint& point) {
  double area = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const ImagePoint& from = hull[i];
    const ImagePoint& to = hull[(i + 1) % hull.size()];
    area += from.u * to.v - to.u * from.v;
  }
  const double sense = area >= 0 ? 1 : -1;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const ImagePoint& from = hull[i];
    const ImagePoint& to = hull[(i + 1) % hull.size()];
    const double length = hypot(to.u - from.u, to.v - from.v);
    if (length == 0) continue;
    const double left = (to.u - from.u) * (point.v - from.v) - (to.v - from.v) * (point.u - from.u);
    most = std::max(most, -sense * left / length);
  }
  return most;
}

}  // namespace

std::optional<double> share_beyond_reach(const CameraCalibration& lens, const CameraPlace& place,
                                         const Arena& arena) {
  if (lens.hull.size() < 3 || arena.walls.empty()) return std::nullopt;
  Point low = arena.walls.front().from;
  Point high = low;
  for (const Wall& wall : arena.walls) {
    low = {std::min(low.x, wall.from.x), std::min(low.y, wall.from.y)};
    high = {std::max(high.x, wall.from.x), std::max(high.y, wall.from.y)};
  }
  const ImageSize size = lens.model.size;
  const double margin = kMargin * std::max(size.width, size.height);
  int seen = 0;
  int beyond = 0;
  const int columns = static_cast<int>((high.x - low.x) / kGrid_m);
  const int rows = static_cast<int>((high.y - low.y) / kGrid_m);
  for (int i = 0; i <= columns; ++i) {
    for (int j = 0; j <= rows; ++j) {
      const Point at{low.x + i * kGrid_m, low.y + j * kGrid_m};
      if (!is_inside(arena, at)) continue;
      const Point3 there = place.seen_from_camera({at.x, at.y, 0});
      if (!(there.z > 0)) continue;
      const ImagePoint pixel = image_of(lens.model, there);
      if (!(pixel.u >= 0 && pixel.v >= 0 && pixel.u < size.width && pixel.v < size.height))
        continue;
      ++seen;
      if (outside_by(lens.hull, pixel) > margin) ++beyond;
    }
  }
  if (seen == 0) return std::nullopt;
  return static_cast<double>(beyond) / seen;
}

}  // namespace swarmsmith
