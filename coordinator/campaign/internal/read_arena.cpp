#include "coordinator/campaign/internal/read_arena.h"

#include <cmath>

#include "coordinator/campaign/internal/color_text.h"

namespace swarmsmith {
namespace {

constexpr Limits<double> kCoordinate{-100, 100};
constexpr Limits<double> kSize{0.001, 100};

/// A number that must be there.
double need(TableReader& table, std::string_view key, Limits<double> limits) {
  if (!table.has(key)) table.complain(key, table.name() + " needs `" + std::string(key) + "`");
  return table.number(key, limits).value_or(limits.most);
}

/// Where the middle of a spot is.
Point read_centre(TableReader& table) {
  return {need(table, "x", kCoordinate), need(table, "y", kCoordinate)};
}

/// A square has a `side`, a rectangle `width` and `height`.
Rectangle read_rectangle(TableReader& table, bool square) {
  Rectangle shape{.centre = read_centre(table), .width_m = 0, .height_m = 0};
  shape.width_m = need(table, square ? "side" : "width", kSize);
  shape.height_m = square ? shape.width_m : need(table, "height", kSize);
  return shape;
}

/// One entry of `spots`.
std::optional<Patch> read_spot(TableReader& table) {
  static const std::vector<std::string> kShapes = {"circle", "square", "rectangle"};
  const auto shape = table.choice("shape", kShapes);
  if (!table.has("shape")) table.complain("shape", "a spot needs a `shape`: circle or square");
  if (!shape) return std::nullopt;
  Patch patch;
  if (*shape == "circle") {
    const Point centre = read_centre(table);
    patch.shape = Disc{.centre = centre, .radius_m = need(table, "diameter", kSize) / 2};
  } else {
    patch.shape = read_rectangle(table, *shape == "square");
  }
  patch.color = read_color(table, "color").value_or(Rgb{});
  table.finish();
  return patch;
}

/// The table `shuffled`: which colours, on which places.
ShuffledPatches read_shuffled(TableReader& table) {
  ShuffledPatches shuffled;
  for (TableReader& place : table.tables("places")) {
    shuffled.places.push_back(read_rectangle(place, place.has("side")));
    place.finish();
  }
  if (!table.has("places")) table.complain("places", table.name() + " needs `places`");
  std::size_t patches = 0;
  if (auto colors = table.table("colors")) {
    for (const auto& [name, color] : read_color_keys(*colors)) {
      const auto count = colors->integer(name, {1, 10'000}).value_or(1);
      shuffled.shares.push_back({color, static_cast<int>(count)});
      patches += static_cast<std::size_t>(count);
    }
  } else {
    table.complain("colors", table.name() + " needs `colors`, such as { red = 4 }");
  }
  if (patches > shuffled.places.size()) {
    table.complain("colors", "`colors` asks for " + std::to_string(patches) +
                                 " patches, `places` has " +
                                 std::to_string(shuffled.places.size()));
  }
  table.finish();
  return shuffled;
}

/// Walls of a given area, and the placement disc scaled with them (1.2 m within 1.226 m in the
/// thesis).
void set_area(CampaignMission& mission, double area_m2) {
  constexpr double kInradius_m = 1.226;
  constexpr double kRadius_m = 1.2;
  mission.area_m2 = area_m2;
  mission.mission.arena.walls = regular_dodecagon(area_m2).walls;
  // A regular dodecagon of inradius r has the area 12 r^2 tan 15 degrees.
  const double inradius_m = std::sqrt(area_m2 / (12 * (2 - std::sqrt(3.0))));
  mission.mission.placement =
      PlaceInDisc{.centre = {}, .radius_m = inradius_m * kRadius_m / kInradius_m};
}

}  // namespace

std::optional<Rgb> read_color(TableReader& table, std::string_view key) {
  if (!table.has(key)) {
    table.take(key);
    table.complain(key, table.name() + " needs a `" + std::string(key) + "`");
    return std::nullopt;
  }
  const auto text = table.text(key);
  if (!text) return std::nullopt;
  const auto color = parse_color(*text);
  if (!color) {
    table.complain(key, "there is no colour \"" + *text + "\"; known are: " + known_colors());
  }
  return color;
}

std::vector<std::pair<std::string, Rgb>> read_color_keys(TableReader& table) {
  std::map<std::string, std::pair<std::string, Rgb>> by_name;
  for (const auto& [key, node] : table.take_all()) {
    const auto color = parse_color(key);
    if (!color) {
      table.complain(key, "there is no colour \"" + key + "\"; known are: " + known_colors());
      continue;
    }
    if (!by_name.try_emplace(color_text(*color), key, *color).second) {
      table.complain(key, "the colour " + color_text(*color) + " is there twice");
    }
  }
  std::vector<std::pair<std::string, Rgb>> keys;
  for (auto& [name, key] : by_name)
    keys.push_back(std::move(key));
  return keys;
}

/// Spots replace those of the preset, since one cannot take away what is not named.
bool read_arena(TableReader& table, CampaignMission& mission) {
  Mission& built = mission.mission;
  static const std::vector<std::string> kNotYet = {"square", "circle", "rectangle", "polygon",
                                                   "hexagon"};
  const auto shape = table.choice("shape", std::vector<std::string>{"dodecagon"}, kNotYet);
  const auto area = table.number("area", {0.2, 10'000});
  if (area) set_area(mission, *area);
  if (table.has("floor")) built.arena.floor = read_color(table, "floor").value_or(Rgb{});
  table.take("floor");
  if (table.has("spots")) {
    built.arena.patches.clear();
    built.shuffled = {};
    for (TableReader& spot : table.tables("spots")) {
      if (const auto patch = read_spot(spot)) built.arena.patches.push_back(*patch);
    }
  }
  table.take("spots");
  if (auto shuffled = table.table("shuffled")) built.shuffled = read_shuffled(*shuffled);
  static const std::vector<std::string> kNoKeysYet = {"obstacles", "lights", "walls"};
  table.finish(kNoKeysYet);
  return (shape || !table.has("shape")) && (area || !table.has("area"));
}

}  // namespace swarmsmith
