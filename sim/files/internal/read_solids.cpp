#include "sim/files/internal/read_solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/math.h"
#include "base/overloaded.h"
#include "base/text/toml_text.h"
#include "sim/files/read_place.h"
#include "sim/mission/polygon.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kMostCorners = 8;
constexpr std::array<const char*, 5> kSizeKeys = {"diameter", "side", "length", "width", "corners"};
constexpr Limits<double> kHeight{0.001, 100};
constexpr Limits<double> kSolidSize{0.005, 100};

/// Moves the corners so that the solid's origin is their centre of mass. Corners that are already
/// centred within rounding stay, so that written texts read back to the same bits.
void centre_corners(std::vector<Point>& corners, Pose& pose) {
  const Point middle = centroid(corners);
  if (std::fabs(middle.x) < 1e-12 && std::fabs(middle.y) < 1e-12) return;
  for (Point& corner : corners)
    corner = {corner.x - middle.x, corner.y - middle.y};
  const SinCos heading = sin_cos(pose.theta);
  pose.x += middle.x * heading.cos - middle.y * heading.sin;
  pose.y += middle.x * heading.sin + middle.y * heading.cos;
}

/// The corners of a robot's body are written with fewer digits than a double has.
bool is_centred(const std::vector<Point>& corners) {
  constexpr double kTolerance_m = 1e-5;
  const Point middle = centroid(corners);
  return std::fabs(middle.x) <= kTolerance_m && std::fabs(middle.y) <= kTolerance_m;
}

/// A tenth of the tolerance of is_centred.
std::string micrometres_text(double metres) {
  return number_text(std::round(metres * 1e6) / 1e6 + 0.0);
}

std::optional<Outline> read_polygon(TableReader& table, Pose* pose) {
  const auto rows = table.number_rows("corners", 2, kCoordinate, "[[0, 0], [1, 0], [0, 1]]");
  if (!rows) {
    if (!table.has("corners")) table.complain("corners", table.name() + " needs `corners`");
    return std::nullopt;
  }
  std::vector<Point> corners;
  for (const auto& row : *rows)
    corners.push_back({row[0], row[1]});
  std::optional<std::string> flaw = flaw_of(corners);
  if (!flaw && signed_area(corners) < 0) std::reverse(corners.begin() + 1, corners.end());
  if (!flaw && !is_convex(corners)) {
    flaw = "it is not convex";
    if (pose != nullptr) *flaw += "; build it from several convex ones";
  }
  if (!flaw && corners.size() > kMostCorners) {
    flaw = std::to_string(corners.size()) + " corners; at most " + std::to_string(kMostCorners) +
           " are allowed";
  }
  if (!flaw && pose == nullptr && !is_centred(corners)) {
    const Point middle = centroid(corners);
    flaw = "its centre of mass is [" + micrometres_text(middle.x) + ", " +
           micrometres_text(middle.y) +
           "], but a robot's must be at [0, 0]; give its corners, and all other places on it, "
           "relative to that point";
  }
  if (flaw) {
    table.complain("corners", std::string("this polygon cannot be ") +
                                  (pose != nullptr ? "in an arena: " : "a robot's body: ") + *flaw);
    return std::nullopt;
  }
  Pose unmoved;
  centre_corners(corners, pose != nullptr ? *pose : unmoved);
  if (!can_be_read(corners)) {
    table.complain("corners", "this polygon has corners beyond " + number_text(kCoordinate.most) +
                                  " m from its centre of mass along x or y; make it smaller");
    return std::nullopt;
  }
  return PolygonOutline{std::move(corners)};
}

/// The keys for the sizes of a shape, which are allowed without `shape`.
struct ShapeKeys {
  std::string_view shape;  ///< "a circle"
  std::vector<std::string_view> keys;
};

ShapeKeys keys_of(const Outline& outline) {
  return std::visit(Overloaded{[](const CircleOutline&) {
                                 return ShapeKeys{"a circle", {"diameter"}};
                               },
                               [](const BoxOutline& box) {
                                 if (box.length_m == box.width_m)
                                   return ShapeKeys{"a square", {"side", "length", "width"}};
                                 return ShapeKeys{"a box", {"length", "width"}};
                               },
                               [](const PolygonOutline&) {
                                 return ShapeKeys{"a polygon", {"corners"}};
                               }},
                    outline);
}

/// The box with the sizes that the table gives.
std::optional<Outline> read_changed_box(TableReader& table, Limits<double> size, BoxOutline box) {
  if (table.has("side") && (table.has("length") || table.has("width"))) {
    table.complain("side", "`side` is both length and width; leave out `side`, or the others");
    for (const char* key : {"side", "length", "width"})
      table.take(key);
    return std::nullopt;
  }
  const auto side_m = table.number("side", size);
  box.length_m = table.number("length", size).value_or(side_m.value_or(box.length_m));
  box.width_m = table.number("width", size).value_or(side_m.value_or(box.width_m));
  return box;
}

/// Reads the pose of a solid; the corners of a polygon may replace x and y.
Pose read_pose(TableReader& table) {
  const bool by_corners = !table.has("x") && !table.has("y") && table.has("corners");
  const Point place = by_corners ? Point{} : need_point(table);
  return {place.x, place.y, read_heading(table)};
}

std::optional<Obstacle> read_obstacle(TableReader& table) {
  Obstacle obstacle;
  obstacle.pose = read_pose(table);
  auto outline = read_outline(table, kSolidSize, &obstacle.pose);
  obstacle.height_m = table.number("height", kHeight).value_or(obstacle.height_m);
  table.finish();
  if (!outline) return std::nullopt;
  obstacle.outline = std::move(*outline);
  return obstacle;
}

std::optional<MovableObject> read_object(TableReader& table) {
  MovableObject object;
  object.start = read_pose(table);
  auto outline = read_outline(table, kSolidSize, &object.start);
  object.mass_kg = need(table, "mass", {0.001, 10'000});
  object.friction_N = need(table, "friction", {0, 100'000});
  object.height_m = table.number("height", kHeight).value_or(object.height_m);
  table.finish();
  if (!outline) return std::nullopt;
  object.outline = std::move(*outline);
  return object;
}

Light read_light(TableReader& table) {
  Light light;
  const Point place = need_point(table);
  light.x_m = place.x;
  light.y_m = place.y;
  light.z_m = table.number("z", {0, 100}).value_or(light.z_m);
  light.intensity_cd = table.number("intensity", {0, 1e9}).value_or(light.intensity_cd);
  table.finish();
  return light;
}

}  // namespace

std::optional<Outline> read_outline(TableReader& table, Limits<double> size, Pose* pose) {
  static const std::vector<std::string> kShapes = {"circle", "square", "box", "polygon"};
  const auto shape = table.choice("shape", kShapes);
  if (!table.has("shape")) {
    table.complain("shape", table.name() + " needs a `shape`: circle, square, box or polygon");
  }
  if (!shape) {
    for (const char* key : kSizeKeys)
      table.take(key);  // without a shape, these keys cannot be checked
    return std::nullopt;
  }
  if (*shape == "circle") return CircleOutline{need(table, "diameter", size) / 2};
  if (*shape == "polygon") return read_polygon(table, pose);
  if (*shape == "square") {
    const double side_m = need(table, "side", size);
    return BoxOutline{side_m, side_m};
  }
  const double length_m = need(table, "length", size);
  return BoxOutline{length_m, need(table, "width", size)};
}

std::optional<Outline> read_changed_outline(TableReader& table, Limits<double> size,
                                            const Outline& base) {
  if (table.has("shape")) return read_outline(table, size, nullptr);
  table.take("shape");  // so that it is among the keys that are known here
  const ShapeKeys own = keys_of(base);
  bool has_own = false;
  bool has_other = false;
  for (const char* key : kSizeKeys) {
    const bool is_own = std::ranges::find(own.keys, key) != own.keys.end();
    const bool is_there = table.has(key);
    has_own = has_own || (is_own && is_there);
    if (is_own) continue;
    table.take(key);
    if (!is_there) continue;
    has_other = true;
    table.complain(key, "the base's shape is " + std::string(own.shape) + ", which has no `" + key +
                            "`; give the `shape`, too");
  }
  if (!has_own || has_other) {
    for (const char* key : kSizeKeys)
      table.take(key);
    return std::nullopt;
  }
  return std::visit(
      Overloaded{[&](CircleOutline circle) -> std::optional<Outline> {
                   const auto diameter_m = table.number("diameter", size);
                   if (diameter_m) circle.radius_m = *diameter_m / 2;
                   return circle;
                 },
                 [&](const BoxOutline& box) { return read_changed_box(table, size, box); },
                 [&](const PolygonOutline&) { return read_polygon(table, nullptr); }},
      base);
}

void read_solids(TableReader& arena, Arena& into) {
  if (arena.has("obstacles")) {
    into.obstacles.clear();
    for (TableReader& table : arena.tables("obstacles")) {
      const auto obstacle = read_obstacle(table);
      if (obstacle) into.obstacles.push_back(*obstacle);
    }
  }
  if (arena.has("objects")) {
    into.objects.clear();
    for (TableReader& table : arena.tables("objects")) {
      const auto object = read_object(table);
      if (object) into.objects.push_back(*object);
    }
  }
  if (arena.has("lights")) {
    into.lights.clear();
    for (TableReader& table : arena.tables("lights"))
      into.lights.push_back(read_light(table));
  }
  for (const char* key : {"obstacles", "objects", "lights"})
    arena.take(key);
}

}  // namespace swarmsmith
