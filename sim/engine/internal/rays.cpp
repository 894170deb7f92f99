#include "sim/engine/internal/rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/control/readings.h"
#include "sim/engine/internal/crossing.h"
#include "sim/engine/internal/two.h"

namespace swarmsmith {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Faces extend this far beyond their ends, so that rounding cannot let a ray pass through a
/// corner.
constexpr double kSlack_m = 1e-12;

/// The eight rays lie on four lines through the centre: on each line one ray points ahead, one
/// back.
struct Line {
  double x;  ///< unit vector in the robot's frame
  double y;
  std::size_t ahead;  ///< index of the sensor
  std::size_t back;
};

constexpr std::array<Line, 4> kLines = {Line{1, 0, 1, 5}, Line{0, 1, 7, 3},
                                        Line{kSqrtHalf, kSqrtHalf, 0, 4},
                                        Line{-kSqrtHalf, kSqrtHalf, 6, 2}};

/// One coordinate of the unit vectors of all lines.
using Coordinates = std::array<Two, 2>;
constexpr Coordinates kLinesX = {Two{1, 0}, Two{kSqrtHalf, -kSqrtHalf}};
constexpr Coordinates kLinesY = {Two{0, 1}, Two{kSqrtHalf, kSqrtHalf}};

/// The pose of one square in the frame of another.
struct Relative {
  double x;
  double y;
  double cos;
  double sin;
};

/// Distance from the ray's start to the square at `at`, for the ray along (ux, uy).
double distance_to_square(double ux, double uy, const Relative& at) {
  const double sx = ux * kRayStart_m - at.x;
  const double sy = uy * kRayStart_m - at.y;
  const double ox = at.cos * sx + at.sin * sy;
  const double oy = at.cos * sy - at.sin * sx;
  if (std::fabs(ox) < kHalfSide_m && std::fabs(oy) < kHalfSide_m) return kInfinity;
  const double dx = at.cos * ux + at.sin * uy;
  const double dy = at.cos * uy - at.sin * ux;
  // Only the two faces that face the ray can be hit first.
  double nearest = kInfinity;
  if (dx != 0) {
    const double t = (-std::copysign(kHalfSide_m, dx) - ox) / dx;
    if (t >= 0 && std::fabs(oy + t * dy) <= kHalfSide_m) nearest = t;
  }
  if (dy != 0) {
    const double t = (-std::copysign(kHalfSide_m, dy) - oy) / dy;
    if (t >= 0 && t < nearest && std::fabs(ox + t * dx) <= kHalfSide_m) nearest = t;
  }
  return nearest;
}

/// Whether a line through the robot's centre crosses the wall's line between its ends. `normal` is
/// the wall's normal in the robot's frame.
bool is_on_face(const Body& self, const WallPlane& wall, double depth, Vector2 normal,
                Vector2 line) {
  const double cosine = normal.x * line.x + normal.y * line.y;
  const double from_centre = cosine == 0 ? 0 : depth / cosine;
  const double sideways = normal.x * line.y - normal.y * line.x;
  const double along = wall.along(self.x, self.y) + from_centre * sideways;
  return along >= -kSlack_m && along <= wall.length_m + kSlack_m;
}

}  // namespace

void meet_walls(const Body& self, double start_m, const Walls& walls, double range_m,
                RayDistances& distances) {
  constexpr Two kNone = {kInfinity, kInfinity};
  const double sight = start_m + range_m;
  const double clear = walls.clear_radius_m - sight;
  const bool sees_none = clear > 0 && self.x * self.x + self.y * self.y < clear * clear;
  if (sees_none || walls.planes.empty()) {
    for (std::size_t i = 0; i < kProximitySensors; i += 2)
      store_two(kNone, &distances[i]);
    return;
  }
  constexpr Two kZero = {0, 0};
  std::array<Two, 2> ahead = {kNone, kNone};
  std::array<Two, 2> back = {kNone, kNone};
  for (const WallPlane& wall : walls.planes) {
    const double depth = wall.depth_of(self.x, self.y);
    if (depth > sight || depth < 0) continue;
    const double nx = wall.nx * self.cos + wall.ny * self.sin;
    const double ny = wall.ny * self.cos - wall.nx * self.sin;
    for (std::size_t i = 0; i < 2; ++i) {
      // Selected without a branch: the lines that hit a wall change with every turn.
      const Two cosine = nx * kLinesX[i] + ny * kLinesY[i];
      const Two size = size_of(cosine);
      const Two distance = depth / size - start_m;
      Two met = depth <= sight * size ? (distance > 0 ? distance : kZero) : kNone;
      if (!walls.convex) {
        for (std::size_t k = 0; k < 2; ++k) {
          if (!is_on_face(self, wall, depth, {nx, ny}, {kLines[2 * i + k].x, kLines[2 * i + k].y}))
            met[k] = kInfinity;
        }
      }
      ahead[i] = lesser(ahead[i], cosine > 0 ? met : kNone);
      back[i] = lesser(back[i], cosine > 0 ? kNone : met);
    }
  }
  // Stored in pairs, in the order in which they are read next: reading a pair right after its parts
  // were written one by one stalls.
  static_assert(kLines[2].ahead == 0 && kLines[0].ahead == 1 && kLines[3].back == 2 &&
                kLines[1].back == 3 && kLines[2].back == 4 && kLines[0].back == 5 &&
                kLines[3].ahead == 6 && kLines[1].ahead == 7);
  store_two(Two{ahead[1][0], ahead[0][0]}, distances.data());
  store_two(Two{back[1][1], back[0][1]}, &distances[2]);
  store_two(Two{back[1][0], back[0][0]}, &distances[4]);
  store_two(Two{ahead[1][1], ahead[0][1]}, &distances[6]);
}

void meet_walls(const Body& self, const Ring& ring, double start_m, const Walls& walls,
                double range_m, RayDistances& distances) {
  for_each_reading(ring.readings, [&](std::size_t i) { distances[i] = kInfinity; });
  const double sight = start_m + range_m;
  for (const WallPlane& wall : walls.planes) {
    const double depth = wall.depth_of(self.x, self.y);
    if (depth > sight || depth < 0) continue;
    const Vector2 normal = {wall.nx * self.cos + wall.ny * self.sin,
                            wall.ny * self.cos - wall.nx * self.sin};
    for (std::size_t i = 0; i < ring.count; ++i) {
      const Vector2& ray = ring.directions[i];
      const double cosine = normal.x * ray.x + normal.y * ray.y;
      if (!(cosine > 0) || depth > sight * cosine) continue;
      const double distance = depth / cosine - start_m;
      if (distance < 0 && !ring.touches_walls) continue;
      if (!walls.convex && !is_on_face(self, wall, depth, normal, ray)) continue;
      distances[i] = std::min(distances[i], std::max(distance, 0.0));
    }
  }
}

namespace {

/// meet_solid for a circle of this radius.
void meet_circle(const Body& self, const Ring& ring, double start_m, double radius_m, Vector2 apart,
                 RayDistances& distances) {
  const double x = self.cos * apart.x + self.sin * apart.y;
  const double y = self.cos * apart.y - self.sin * apart.x;
  const double radius2 = radius_m * radius_m;
  for (std::size_t i = 0; i < ring.count; ++i) {
    const Vector2& ray = ring.directions[i];
    const double aside = ray.x * y - ray.y * x;
    const double half2 = radius2 - aside * aside;
    if (half2 < 0) continue;
    const double distance = ray.x * x + ray.y * y - std::sqrt(half2) - start_m;
    if (distance >= 0) distances[i] = std::min(distances[i], distance);
  }
}

}  // namespace

void meet_solid(const Body& self, const Ring& ring, double start_m, const Form& form,
                const Body& at, double range_m, RayDistances& distances) {
  const double sight = start_m + range_m + form.radius_m;
  const double dx = at.x - self.x;
  const double dy = at.y - self.y;
  if (dx * dx + dy * dy > sight * sight) return;
  if (form.is_circle() && !ring.is_rvr) {
    return meet_circle(self, ring, start_m, form.radius_m, {dx, dy}, distances);
  }
  for (std::size_t i = 0; i < ring.count; ++i) {
    const Vector2 local = ring.directions[i];
    const Point ray = {self.cos * local.x - self.sin * local.y,
                       self.sin * local.x + self.cos * local.y};
    if (std::fabs(ray.x * dy - ray.y * dx) > form.radius_m) continue;
    const Point start = {self.x + start_m * ray.x, self.y + start_m * ray.y};
    const Stretch inside = stretch_in(form, at, start, ray);
    if (!inside.empty() && inside.from >= 0) distances[i] = std::min(distances[i], inside.from);
  }
}

void meet_robot(const Body& self, const Body& other, double range_m, RayDistances& distances) {
  const double dx = other.x - self.x;
  const double dy = other.y - self.y;
  const Relative at = {.x = self.cos * dx + self.sin * dy,
                       .y = self.cos * dy - self.sin * dx,
                       .cos = self.cos * other.cos + self.sin * other.sin,
                       .sin = self.cos * other.sin - self.sin * other.cos};
  const double sight = sight_of_robots_m(range_m);
  // A ray covers the half of the line that begins at its start.
  constexpr double kBehind_m = kRayStart_m - kCornerRadius_m;
  for (const Line& line : kLines) {
    const double aside = line.x * at.y - line.y * at.x;
    if (std::fabs(aside) > kCornerRadius_m) continue;
    const double along = line.x * at.x + line.y * at.y;
    if (along >= kBehind_m && along <= sight) {
      double& distance = distances[line.ahead];
      distance = std::min(distance, distance_to_square(line.x, line.y, at));
    }
    if (-along >= kBehind_m && -along <= sight) {
      double& distance = distances[line.back];
      distance = std::min(distance, distance_to_square(-line.x, -line.y, at));
    }
  }
}

}  // namespace swarmsmith
