#include "tracking/rig/lens_reach.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "base/math.h"
#include "sim/mission/polygon.h"

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

/// The convex hull of points, counter-clockwise (Andrew's monotone chain).
std::vector<Point> hull_of(std::vector<Point> points) {
  std::ranges::sort(points, [](const Point& a, const Point& b) {
    return a.x < b.x || (a.x == b.x && a.y < b.y);
  });
  std::vector<Point> hull;
  const auto add = [&](const Point& point, std::size_t least) {
    const auto turns_left = [&](const Point& a, const Point& b) {
      return (b.x - a.x) * (point.y - a.y) > (b.y - a.y) * (point.x - a.x);
    };
    while (hull.size() > least && !turns_left(hull[hull.size() - 2], hull.back()))
      hull.pop_back();
    hull.push_back(point);
  };
  for (const Point& point : points)
    add(point, 1);
  const std::size_t lower = hull.size();
  for (auto point = points.rbegin(); point != points.rend(); ++point)
    add(*point, lower);
  if (hull.size() > 1) hull.pop_back();
  return hull;
}

}  // namespace

double share_within_tags(std::span<const ReferenceTag> tags, const View& view,
                         std::span<const Point> arena) {
  std::vector<Point> corners;
  for (const ReferenceTag& tag : tags)
    std::ranges::copy(corners_of(tag), std::back_inserter(corners));
  const std::vector<Point> hull = hull_of(std::move(corners));
  if (hull.size() < 3 || arena.empty()) return 0;
  Point low = arena.front();
  Point high = low;
  for (const Point& corner : arena) {
    low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
    high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
  }
  constexpr double kCells_1_m = 50;
  constexpr double kMostCells = 500;
  const double cells_1_m =
      std::min(kCells_1_m, kMostCells / std::max(high.x - low.x, high.y - low.y));
  const auto cell = [&](double at) { return static_cast<int>(std::floor(at * cells_1_m)); };
  int seen = 0;
  int covered = 0;
  for (int row = cell(low.y); row <= cell(high.y); ++row) {
    for (int column = cell(low.x); column <= cell(high.x); ++column) {
      const Point point{(column + 0.5) / cells_1_m, (row + 0.5) / cells_1_m};
      if (!is_within(arena, point)) continue;
      const Point3 from_camera = view.place.seen_from_camera({point.x, point.y, 0});
      if (!(from_camera.z > 0)) continue;
      const ImagePoint pixel = image_of(view.camera, from_camera);
      if (!(pixel.u >= 0 && pixel.v >= 0 && pixel.u <= view.camera.size.width - 1 &&
            pixel.v <= view.camera.size.height - 1)) {
        continue;
      }
      ++seen;
      if (is_within(hull, point)) ++covered;
    }
  }
  return seen == 0 ? 0 : static_cast<double>(covered) / seen;
}

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
