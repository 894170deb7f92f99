#include "sim/mission/arena.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "base/math.h"
#include "base/overloaded.h"

namespace swarmsmith {
namespace {

constexpr int kSides = 12;
constexpr double kWallThickness_m = 0.01;

/// The line of points p with normal . p = distance; the normal has length 1 and points outwards.
struct Line {
  Point normal;
  double distance = 0;
};

Point crossing(const Line& a, const Line& b) {
  const double det = a.normal.x * b.normal.y - a.normal.y * b.normal.x;
  return {(a.distance * b.normal.y - b.distance * a.normal.y) / det,
          (b.distance * a.normal.x - a.distance * b.normal.x) / det};
}

/// The polygon between lines whose normals turn counter-clockwise.
std::vector<Wall> walls_between(std::span<const Line> lines) {
  std::vector<Wall> walls;
  const std::size_t n = lines.size();
  for (std::size_t i = 0; i < n; ++i) {
    walls.push_back(
        {crossing(lines[(i + n - 1) % n], lines[i]), crossing(lines[i], lines[(i + 1) % n])});
  }
  return walls;
}

/// Unit vector at 30 k degrees, k in 0..11, with exact zeros and halves.
Point direction_of_side(int k) {
  const double half_root_three = 0.5 * std::sqrt(3.0);
  const std::array<double, kSides> cosines = {1,  half_root_three,  0.5,  0, -0.5, -half_root_three,
                                              -1, -half_root_three, -0.5, 0, 0.5,  half_root_three};
  const auto at = [&cosines](int i) { return cosines[static_cast<std::size_t>(i % kSides)]; };
  return {at(k), at(k + 9)};
}

}  // namespace

bool contains(const Patch& patch, Point point) {
  return std::visit(Overloaded{[point](const Disc& disc) {
                                 const double dx = point.x - disc.centre.x;
                                 const double dy = point.y - disc.centre.y;
                                 return dx * dx + dy * dy <= disc.radius_m * disc.radius_m;
                               },
                               [point](const Rectangle& box) {
                                 return std::fabs(point.x - box.centre.x) <= 0.5 * box.width_m &&
                                        std::fabs(point.y - box.centre.y) <= 0.5 * box.height_m;
                               }},
                    patch.shape);
}

Rgb floor_at(const Arena& arena, Point point) {
  for (auto patch = arena.patches.rbegin(); patch != arena.patches.rend(); ++patch) {
    if (contains(*patch, point)) return patch->color;
  }
  return arena.floor;
}

Arena dodecagon_of_the_thesis() {
  // Centres of walls 0 to 2 of the program's table, side by side from the x axis; the others are
  // theirs turned by quarters, since the table is rounded alike in all quarters.
  const std::array<Point, 3> centres = {{{1.231, 0}, {1.066, 0.615}, {0.615, 1.066}}};
  std::array<Line, kSides> lines;
  for (int k = 0; k < kSides; ++k) {
    const Point centre = centres[static_cast<std::size_t>(k % 3)];
    const Point normal = direction_of_side(k % 3);
    const double middle = centre.x * normal.x + centre.y * normal.y;
    lines[static_cast<std::size_t>(k)] = {direction_of_side(k), middle - 0.5 * kWallThickness_m};
  }
  return {.walls = walls_between(lines), .patches = {}};
}

Arena regular_dodecagon(double area_m2) {
  // Twelve triangles of height r and base 2 r tan 15 degrees; tan 15 degrees = 2 - sqrt 3.
  const double inradius = std::sqrt(area_m2 / (kSides * (2 - std::sqrt(3.0))));
  std::array<Line, kSides> lines;
  for (int k = 0; k < kSides; ++k) {
    lines[static_cast<std::size_t>(k)] = {direction_of_side(k), inradius};
  }
  return {.walls = walls_between(lines), .patches = {}};
}

double area_of(const Arena& arena) {
  double doubled = 0;
  for (const Wall& wall : arena.walls) {
    doubled += wall.from.x * wall.to.y - wall.to.x * wall.from.y;
  }
  return 0.5 * doubled;
}

}  // namespace swarmsmith
