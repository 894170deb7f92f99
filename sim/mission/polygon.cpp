#include "sim/mission/polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>

#include "base/math.h"
#include "base/plain_text.h"

namespace swarmsmith {
namespace {

/// Corners nearer than this count as one.
constexpr double kSamePoint_m = 1e-6;
/// Sides that are given separately must meet within this.
constexpr double kLargestGap_m = 1e-3;
constexpr double kSmallestArea_m2 = 1e-6;

/// Twice the area of the triangle a, b, c; positive when it is counter-clockwise.
double turn(Point a, Point b, Point c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double distance(Point a, Point b) {
  return hypot(b.x - a.x, b.y - a.y);
}

/// Whether c, on the line through a and b, lies between them.
bool is_between(Point a, Point b, Point c) {
  return std::min(a.x, b.x) <= c.x && c.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= c.y &&
         c.y <= std::max(a.y, b.y);
}

/// Whether two segments have a point in common.
bool meet(Side one, Side two) {
  const double a = turn(one.from, one.to, two.from);
  const double b = turn(one.from, one.to, two.to);
  const double c = turn(two.from, two.to, one.from);
  const double d = turn(two.from, two.to, one.to);
  if (((a > 0 && b < 0) || (a < 0 && b > 0)) && ((c > 0 && d < 0) || (c < 0 && d > 0))) return true;
  return (a == 0 && is_between(one.from, one.to, two.from)) ||
         (b == 0 && is_between(one.from, one.to, two.to)) ||
         (c == 0 && is_between(two.from, two.to, one.from)) ||
         (d == 0 && is_between(two.from, two.to, one.to));
}

Side side_of(std::span<const Point> corners, std::size_t i) {
  return {corners[i], corners[(i + 1) % corners.size()]};
}

Point crossing(const Line& a, const Line& b) {
  const double det = a.normal.x * b.normal.y - a.normal.y * b.normal.x;
  return {(a.distance_m * b.normal.y - b.distance_m * a.normal.y) / det,
          (b.distance_m * a.normal.x - a.distance_m * b.normal.x) / det};
}

}  // namespace

double signed_area(std::span<const Point> corners) {
  double doubled = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Side side = side_of(corners, i);
    doubled += side.from.x * side.to.y - side.to.x * side.from.y;
  }
  return 0.5 * doubled;
}

Point centroid(std::span<const Point> corners) {
  Point sum;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Side side = side_of(corners, i);
    const double weight = side.from.x * side.to.y - side.to.x * side.from.y;
    sum.x += weight * (side.from.x + side.to.x);
    sum.y += weight * (side.from.y + side.to.y);
  }
  const double six_areas = 6 * signed_area(corners);
  return {sum.x / six_areas, sum.y / six_areas};
}

bool is_convex(std::span<const Point> corners) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Side side = side_of(corners, i);
    if (turn(side.from, side.to, corners[(i + 2) % corners.size()]) < 0) return false;
  }
  return true;
}

bool is_within(std::span<const Point> corners, Point point) {
  bool within = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Side side = side_of(corners, i);
    if ((side.from.y > point.y) == (side.to.y > point.y)) continue;
    const double rise = (point.y - side.from.y) / (side.to.y - side.from.y);
    if (point.x < side.from.x + rise * (side.to.x - side.from.x)) within = !within;
  }
  return within;
}

std::optional<std::string> flaw_of(std::span<const Point> corners) {
  const std::size_t n = corners.size();
  if (n < 3) return counted(n, "corner") + "; a polygon has at least 3";
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      if (distance(corners[i], corners[j]) > kSamePoint_m) continue;
      std::string flaw = "corners " + std::to_string(i + 1) + " and " + std::to_string(j + 1) +
                         " are the same point, " + point_text(corners[i]);
      if (i == 0 && j == n - 1) flaw += "; the last corner joins the first automatically";
      return flaw;
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Side side = side_of(corners, i);
    const Point next = corners[(i + 2) % n];
    const double along = (side.to.x - side.from.x) * (next.x - side.to.x) +
                         (side.to.y - side.from.y) * (next.y - side.to.y);
    if (turn(side.from, side.to, next) == 0 && along < 0) {
      return "at corner " + std::to_string((i + 1) % n + 1) + ", " + point_text(side.to) +
             ", the border turns back on itself";
    }
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;  // neighbouring sides
      if (!meet(side, side_of(corners, j))) continue;
      return "side " + std::to_string(i + 1) + ", from " + point_text(side.from) +
             ", crosses or touches side " + std::to_string(j + 1) + ", from " +
             point_text(corners[j]);
    }
  }
  if (std::fabs(signed_area(corners)) < kSmallestArea_m2) return "it has no area";
  return std::nullopt;
}

Expected<std::vector<Point>> corners_of(std::span<const Side> sides) {
  std::vector<Point> corners;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const std::size_t next = (i + 1) % sides.size();
    const double gap = distance(sides[i].to, sides[next].from);
    if (gap > kLargestGap_m) {
      char metres[32];
      std::snprintf(metres, sizeof metres, "%.3g", gap);
      return bad_input("not closed: wall " + std::to_string(i + 1) + " ends at " +
                       point_text(sides[i].to) + ", wall " + std::to_string(next + 1) +
                       " begins at " + point_text(sides[next].from) + ", a gap of " + metres +
                       " m");
    }
    corners.push_back(sides[i].from);
  }
  return corners;
}

std::vector<Point> corners_between(std::span<const Line> lines) {
  std::vector<Point> corners;
  for (std::size_t i = 0; i < lines.size(); ++i)
    corners.push_back(crossing(lines[(i + lines.size() - 1) % lines.size()], lines[i]));
  return corners;
}

Point direction_of(int k, int n) {
  if (12 * k % n != 0) {
    const SinCos angle = sin_cos(2 * kPi * k / n);
    return {angle.cos, angle.sin};
  }
  const double half_root_three = 0.5 * std::sqrt(3.0);
  const std::array<double, 12> cosines = {1,  half_root_three,  0.5,  0, -0.5, -half_root_three,
                                          -1, -half_root_three, -0.5, 0, 0.5,  half_root_three};
  const auto at = [&cosines](int i) { return cosines[static_cast<std::size_t>(i % 12)]; };
  return {at(12 * k / n), at(12 * k / n + 9)};
}

std::vector<Point> regular_polygon(int sides, double inradius_m) {
  std::vector<Line> lines;
  lines.reserve(static_cast<std::size_t>(sides));
  for (int k = 0; k < sides; ++k)
    lines.push_back({direction_of(k, sides), inradius_m});
  return corners_between(lines);
}

double inradius_of_area(int sides, double area_m2) {
  // The polygon consists of `sides` triangles of height r and base 2 r tan(pi / sides).
  const SinCos half = sin_cos(kPi / sides);
  return std::sqrt(area_m2 * half.cos / (sides * half.sin));
}

std::string point_text(Point point) {
  char text[64];
  std::snprintf(text, sizeof text, "(%.6g, %.6g)", point.x, point.y);
  return text;
}

}  // namespace swarmsmith
