#include "sim/mission/arena.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "base/overloaded.h"
#include "sim/mission/polygon.h"

namespace swarmsmith {
namespace {

constexpr int kSides = 12;
constexpr double kWallThickness_m = 0.01;

bool covers(const Disc& disc, Point point) {
  const double dx = point.x - disc.centre.x;
  const double dy = point.y - disc.centre.y;
  return dx * dx + dy * dy <= disc.radius_m * disc.radius_m;
}

bool covers(const Rectangle& box, Point point) {
  return std::fabs(point.x - box.centre.x) <= 0.5 * box.width_m &&
         std::fabs(point.y - box.centre.y) <= 0.5 * box.height_m;
}

}  // namespace

std::optional<Rgb> color_at(const Patch& patch, Point point) {
  return std::visit(Overloaded{[&](const Disc& disc) -> std::optional<Rgb> {
                                 if (!covers(disc, point)) return {};
                                 return patch.color;
                               },
                               [&](const Rectangle& box) -> std::optional<Rgb> {
                                 if (!covers(box, point)) return {};
                                 return patch.color;
                               },
                               [&](const FloorImage& image) -> std::optional<Rgb> {
                                 const Rectangle& area = image.area;
                                 const Point top_left = {area.centre.x - 0.5 * area.width_m,
                                                         area.centre.y + 0.5 * area.height_m};
                                 return pixel_at(*image.picture, top_left, area.width_m,
                                                 area.height_m, point);
                               }},
                    patch.shape);
}

Rgb floor_at(const Arena& arena, Point point) {
  for (auto patch = arena.patches.rbegin(); patch != arena.patches.rend(); ++patch) {
    // Handled directly, without std::optional, which would take most of the time.
    if (const auto* disc = std::get_if<Disc>(&patch->shape)) {
      if (covers(*disc, point)) return patch->color;
    } else if (const auto* box = std::get_if<Rectangle>(&patch->shape)) {
      if (covers(*box, point)) return patch->color;
    } else if (const auto color = color_at(*patch, point)) {
      return *color;
    }
  }
  return arena.floor;
}

Arena dodecagon_of_the_thesis() {
  // Centres of walls 0 to 2 in the program's table, counter-clockwise from the x axis. The other
  // walls are these turned by quarters, since the rounding in the table is the same in all
  // quarters.
  const std::array<Point, 3> centres = {{{1.231, 0}, {1.066, 0.615}, {0.615, 1.066}}};
  std::array<Line, kSides> lines;
  for (int k = 0; k < kSides; ++k) {
    const Point centre = centres[static_cast<std::size_t>(k % 3)];
    const Point normal = direction_of(k % 3, kSides);
    const double middle = centre.x * normal.x + centre.y * normal.y;
    lines[static_cast<std::size_t>(k)] = {direction_of(k, kSides), middle - 0.5 * kWallThickness_m};
  }
  return {.walls = walls_around(corners_between(lines)), .patches = {}};
}

std::vector<Wall> walls_around(std::vector<Point> corners) {
  // The first corner stays first, so that the text of the corners reads back to the same walls.
  if (signed_area(corners) < 0) std::reverse(corners.begin() + 1, corners.end());
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < corners.size(); ++i)
    walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
  return walls;
}

Arena regular_dodecagon(double area_m2) {
  return {.walls = walls_around(regular_polygon(kSides, inradius_of_area(kSides, area_m2))),
          .patches = {}};
}

std::vector<Point> corners_of(const Arena& arena) {
  std::vector<Point> corners;
  for (const Wall& wall : arena.walls)
    corners.push_back(wall.from);
  return corners;
}

bool is_inside(const Arena& arena, Point point) {
  return is_within(corners_of(arena), point);
}

double area_of(const Arena& arena) {
  return signed_area(corners_of(arena));
}

}  // namespace swarmsmith
