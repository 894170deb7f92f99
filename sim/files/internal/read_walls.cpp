#include "sim/files/internal/read_mission.h"

#include <algorithm>
#include <array>
#include <string>

#include "base/suggestion.h"
#include "base/text/toml_text.h"
#include "sim/files/read_place.h"
#include "sim/mission/polygon.h"

namespace swarmsmith {
namespace {

constexpr int kDodecagon = 12;
/// Number of walls for a circle; the arena is larger than the circle by a thousandth of its area.
constexpr int kCircleSides = 60;
constexpr std::size_t kMostWallCorners = 200;
constexpr Limits<double> kArea{0.01, 10'000};

/// A key of the walls, with the shapes that have it.
struct WallKey {
  std::string_view key;
  std::vector<std::string_view> shapes;
};
const std::array<WallKey, 9> kWallKeys = {{{"area", {"dodecagon", "regular"}},
                                           {"inradius", {"dodecagon", "regular"}},
                                           {"sides", {"regular"}},
                                           {"diameter", {"circle"}},
                                           {"side", {"square"}},
                                           {"width", {"rectangle"}},
                                           {"height", {"rectangle"}},
                                           {"corners", {"polygon"}},
                                           {"walls", {"polygon"}}}};

/// A key of another shape gets its own complaint, instead of the one about unknown keys.
bool has_keys_of_other_shapes(TableReader& arena, const std::string& shape) {
  bool found = false;
  for (const WallKey& known : kWallKeys) {
    if (std::ranges::find(known.shapes, shape) != known.shapes.end()) continue;
    if (arena.take(known.key) == nullptr) continue;
    found = true;
    const std::vector<std::string> shapes(known.shapes.begin(), known.shapes.end());
    arena.complain(known.key, "`" + std::string(known.key) + "` belongs to shape = \"" +
                                  shapes.front() + "\"; this arena's shape is \"" + shape + "\"");
  }
  return found;
}

/// Reads an inradius or an area; nothing if both are missing or one is wrong.
std::optional<double> read_inradius(TableReader& arena, int sides) {
  const auto inradius = arena.number("inradius", {0.05, 100});
  const auto area = arena.number("area", kArea);
  if (inradius && area) {
    arena.complain("inradius", "`area` and `inradius` define the same size; give only one of them");
    return std::nullopt;
  }
  return area ? inradius_of_area(sides, *area) : inradius;
}

/// Reads `corners = [[x, y], ...]`, or `walls = [[x1, y1, x2, y2], ...]` that join.
std::vector<Point> read_polygon(TableReader& arena) {
  if (arena.has("corners") == arena.has("walls")) {
    arena.complain("walls", "shape = \"polygon\" needs either `corners` or `walls`");
    arena.take("corners");
    arena.take("walls");
    return {};
  }
  const std::string key = arena.has("walls") ? "walls" : "corners";
  std::vector<Point> corners;
  if (const auto rows = arena.number_rows("corners", 2, kCoordinate, "[[0, 0], [1, 0], [0, 1]]")) {
    for (const auto& row : *rows)
      corners.push_back({row[0], row[1]});
  }
  if (const auto rows = arena.number_rows("walls", 4, kCoordinate,
                                          "[[0, 0, 1, 0], [1, 0, 0, 1], [0, 1, 0, 0]]")) {
    std::vector<Side> sides;
    for (const auto& row : *rows)
      sides.push_back({{row[0], row[1]}, {row[2], row[3]}});
    auto joined_sides = corners_of(sides);
    if (!joined_sides) {
      arena.complain(key, "the walls are " + joined_sides.error().message);
      return {};
    }
    corners = std::move(*joined_sides);
  }
  if (corners.empty()) return {};
  if (corners.size() > kMostWallCorners) {
    arena.complain(key, "`" + key + "` has " + std::to_string(corners.size()) +
                            " corners; at most " + std::to_string(kMostWallCorners) +
                            " are allowed");
    return {};
  }
  if (const auto flaw = flaw_of(corners)) {
    arena.complain(key, "these walls do not make an arena: " + *flaw);
    return {};
  }
  return corners;
}

/// The corners of a rectangle around the origin.
std::vector<Point> rectangle(double width_m, double height_m) {
  const double x = width_m / 2;
  const double y = height_m / 2;
  return {{x, -y}, {x, y}, {-x, y}, {-x, -y}};
}

/// Stores have the corners of all shapes, so these must be corners that can be read.
bool has_readable_corners(TableReader& arena, const std::vector<Point>& corners) {
  if (can_be_read(corners)) return true;
  const std::string key = arena.has("diameter") ? "diameter" : "inradius";
  arena.complain(key, "these walls have corners beyond " + number_text(kCoordinate.most) +
                          " m along x or y; give a smaller `" + key + "`");
  return false;
}

/// Sets the walls of the thesis if no size is given; the placement is scaled with the walls.
void set_dodecagon(Mission& mission, std::optional<double> inradius_m) {
  constexpr double kInradius_m = 1.226;
  constexpr double kRadius_m = 1.2;
  mission.arena.walls = inradius_m ? walls_around(regular_polygon(kDodecagon, *inradius_m))
                                   : dodecagon_of_the_thesis().walls;
  const double radius_m = inradius_m ? *inradius_m * kRadius_m / kInradius_m : kRadius_m;
  mission.placement = PlaceInDisc{.centre = {}, .radius_m = radius_m};
}

/// Reads the corners of all shapes except the dodecagon; empty after a complaint.
std::vector<Point> read_corners(TableReader& arena, const std::string& shape) {
  if (shape == "circle") {
    return regular_polygon(kCircleSides, need(arena, "diameter", {0.1, 200}) / 2);
  }
  if (shape == "square") {
    const double side_m = need(arena, "side", {0.1, 200});
    return rectangle(side_m, side_m);
  }
  if (shape == "rectangle") {
    const double width_m = need(arena, "width", {0.1, 200});
    return rectangle(width_m, need(arena, "height", {0.1, 200}));
  }
  if (shape == "polygon") return read_polygon(arena);
  const auto sides = arena.integer("sides", {3, kCircleSides});
  if (!arena.has("sides")) arena.complain("sides", "shape = \"regular\" needs `sides`, 3 to 60");
  const auto inradius = read_inradius(arena, static_cast<int>(sides.value_or(3)));
  if (!arena.has("inradius") && !arena.has("area")) {
    arena.complain("inradius", "shape = \"regular\" needs an `inradius` or an `area`");
  }
  if (!sides || !inradius) return {};
  return regular_polygon(static_cast<int>(*sides), *inradius);
}

}  // namespace

void read_walls(TableReader& arena, Mission& mission) {
  static const std::vector<std::string> kShapes = {"dodecagon", "regular",   "circle",
                                                   "square",    "rectangle", "polygon"};
  const auto given = arena.choice("shape", kShapes);
  const std::string shape = given.value_or("dodecagon");
  const bool is_clear = given || !arena.has("shape");
  if (!is_clear || has_keys_of_other_shapes(arena, shape)) {
    for (const WallKey& known : kWallKeys)
      arena.take(known.key);  // without a valid shape, these keys cannot be checked
    return;
  }
  if (shape == "dodecagon") {
    const auto inradius = read_inradius(arena, kDodecagon);
    const bool has_size = arena.has("area") || arena.has("inradius");
    if (has_size && !inradius) return;
    if (inradius && !has_readable_corners(arena, regular_polygon(kDodecagon, *inradius))) return;
    if (given || has_size) set_dodecagon(mission, inradius);
    return;
  }
  const std::size_t before = arena.complaints();
  std::vector<Point> corners = read_corners(arena, shape);
  if (corners.empty() || arena.complaints() != before) return;
  if (!has_readable_corners(arena, corners)) return;
  mission.arena.walls = walls_around(std::move(corners));
  mission.placement = PlaceAnywhere{};
}

}  // namespace swarmsmith
