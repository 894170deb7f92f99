#include "sim/files/internal/read_floor.h"

#include <string>
#include <utility>

#include "base/base64.h"
#include "base/plain_text.h"
#include "base/text/whole_file.h"
#include "sim/files/internal/read_color.h"
#include "sim/files/read_place.h"

namespace swarmsmith {
namespace {

/// The bytes of an image: from a `file`, or from the text itself, where the program writes them.
Expected<std::string> read_image_bytes(TableReader& table, const ImageSource& images) {
  if (const auto data = table.text("data")) return bytes_from_base64(*data);
  if (!images.folder) return bad_input("an image needs its `data` here");
  if (const auto file = table.text("file")) {
    return read_file(*images.folder / *file, "image", Picture::kMostBytes);
  }
  return bad_input("an image needs a `file`, such as file = \"floor.png\"");
}

/// Reads a spot of shape "image".
std::optional<Patch> read_image(TableReader& table, const ImageSource& images) {
  const Rectangle area = read_rectangle(table, false);
  auto bytes = read_image_bytes(table, images);
  const std::string key = table.has("data") ? "data" : "file";
  table.take("file");
  if (!bytes) {
    table.complain(key, to_string(bytes.error()));
    return std::nullopt;
  }
  auto picture = Picture::from_png(std::move(*bytes), images.most_pixels_in_use);
  if (!picture) {
    const std::string name = key == "file" ? table.text(key).value_or("") + ": " : "";
    table.complain(key, name + picture.error().message);
    return std::nullopt;
  }
  return Patch{.shape = FloorImage{area, std::move(*picture)}, .color = {}};
}

/// Reads one entry of `spots`.
std::optional<Patch> read_spot(TableReader& table, const ImageSource& images) {
  static const std::vector<std::string> kShapes = {"circle", "square", "rectangle", "image"};
  const auto shape = table.choice("shape", kShapes);
  if (!table.has("shape")) {
    table.complain("shape", "a spot needs a `shape`: circle, square, rectangle or image");
  }
  if (!shape) return std::nullopt;
  std::optional<Patch> patch;
  if (*shape == "image") {
    patch = read_image(table, images);
  } else if (*shape == "circle") {
    const Point centre = need_point(table);
    patch = Patch{Disc{.centre = centre, .radius_m = need(table, "diameter", kSize) / 2}, {}};
  } else {
    patch = Patch{read_rectangle(table, *shape == "square"), {}};
  }
  if (*shape != "image") patch->color = read_color(table, "color").value_or(Rgb{});
  table.finish();
  return patch;
}

/// Reads the table `shuffled`: the colours and their places.
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
    table.complain("colors", "`colors` asks for " + counted(patches, "patch", "patches") +
                                 ", but `places` has " + std::to_string(shuffled.places.size()));
  }
  table.finish();
  return shuffled;
}

}  // namespace

Rectangle read_rectangle(TableReader& table, bool square) {
  Rectangle shape{.centre = need_point(table), .width_m = 0, .height_m = 0};
  shape.width_m = need(table, square ? "side" : "width", kSize);
  shape.height_m = square ? shape.width_m : need(table, "height", kSize);
  return shape;
}

void read_floor(TableReader& arena, const ImageSource& images, Mission& mission) {
  if (arena.has("floor")) mission.arena.floor = read_color(arena, "floor").value_or(Rgb{});
  arena.take("floor");
  if (arena.has("spots")) {
    mission.arena.patches.clear();
    mission.shuffled = {};
    for (TableReader& spot : arena.tables("spots")) {
      if (auto patch = read_spot(spot, images)) mission.arena.patches.push_back(std::move(*patch));
    }
  }
  arena.take("spots");
  if (auto shuffled = arena.table("shuffled")) mission.shuffled = read_shuffled(*shuffled);
}

}  // namespace swarmsmith
