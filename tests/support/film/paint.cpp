#include "tests/support/film/paint.h"

#include <algorithm>
#include <cmath>

#include "sim/mission/polygon.h"

namespace swarmsmith::film {
namespace {

constexpr float kInk = 22;     ///< of printed black, grey levels
constexpr float kPaper = 228;  ///< of printed white
constexpr Bgr kBodyTop{52, 48, 44};
constexpr Bgr kBodySide{34, 32, 30};
constexpr Bgr kPlateRim{150, 150, 150};
constexpr Bgr kWall{196, 204, 208};
constexpr Bgr kOutside{74, 78, 80};
constexpr Bgr kSkin{120, 150, 205};

/// Where sample `i` lies in its pixel, from its middle.
float across(int i) {
  return (static_cast<float>(i % kFine) + 0.5F) / kFine - 0.5F;
}
float along(int i) {
  return (static_cast<float>(i / kFine) + 0.5F) / kFine - 0.5F;
}

struct Spot {
  float x, y;
};

/// A sample's ray at height z.
Spot at_height(const Footprint& f, const Point3& camera, int i, float z) {
  const float x = f.x + across(i) * f.x_u + along(i) * f.x_v;
  const float y = f.y + across(i) * f.y_u + along(i) * f.y_v;
  const float part = z / static_cast<float>(camera.z);
  return {x + part * (static_cast<float>(camera.x) - x),
          y + part * (static_cast<float>(camera.y) - y)};
}

Spot into(const Placing& frame, Spot p) {
  const float dx = p.x - frame.x;
  const float dy = p.y - frame.y;
  return {frame.c * dx + frame.s * dy, -frame.s * dx + frame.c * dy};
}

bool within(Spot p, float half) {
  return std::abs(p.x) <= half && std::abs(p.y) <= half;
}

/// Whether the segment meets the square: the slab test.
bool meets_square(Spot from, Spot to, float half) {
  float enter = 0;
  float leave = 1;
  const auto slab = [&](float a, float b) {
    const float d = b - a;
    if (std::abs(d) < 1e-9F) return std::abs(a) <= half;
    const float one = (-half - a) / d;
    const float two = (half - a) / d;
    enter = std::max(enter, std::min(one, two));
    leave = std::min(leave, std::max(one, two));
    return enter <= leave;
  };
  return slab(from.x, to.x) && slab(from.y, to.y);
}

bool paint_plate(const Plate& plate, Spot p, float opening, Bgr& color) {
  if (!within(p, plate.half_m)) return false;
  const auto cells = static_cast<float>(plate.picture->width);
  const float column = p.x / plate.cell_m + cells / 2;
  const float row = cells / 2 - p.y / plate.cell_m;
  if (column < 0 || row < 0 || column > cells || row > cells) {
    color = kPlateRim;
    return true;
  }
  const float gray = plate.picture->at(column, row, opening);
  const float level = kInk + gray / 255 * (kPaper - kInk);
  color = {level, level, level};
  return true;
}

Bgr as_bgr(const Rgb& rgb) {
  // Paper and paint are never as bright or as pure as their names.
  const auto washed = [](std::uint8_t value) { return 12 + 0.86F * static_cast<float>(value); };
  return {washed(rgb.b), washed(rgb.g), washed(rgb.r)};
}

}  // namespace

float moment_of(int sample) {
  constexpr std::array<int, kSamples> kOrder{0, 11, 5, 14, 13, 6, 8, 3, 10, 1, 15, 4, 7, 12, 2, 9};
  return (static_cast<float>(kOrder[static_cast<std::size_t>(sample)]) + 0.5F) / kSamples - 0.5F;
}

void paint(const Painted& thing, const Footprint& pixel, const Point3& camera,
           std::array<Bgr, kSamples>& colors) {
  const float cell_px =
      thing.plate.cell_m / (std::hypot(pixel.x_u, pixel.y_u) *
                            (1 - thing.plate.height_m / static_cast<float>(camera.z)));
  const float opening = std::clamp(1 / (kFine * cell_px), 0.01F, 1.0F);
  for (int i = 0; i < kSamples; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Placing& tag = thing.tags[thing.tags.size() == 1 ? 0 : k];
    if (paint_plate(thing.plate, into(tag, at_height(pixel, camera, i, thing.plate.height_m)),
                    opening, colors[k]))
      continue;
    if (thing.body.half_m <= 0) continue;
    const Placing& robot = thing.robots[thing.robots.size() == 1 ? 0 : k];
    const Spot top = into(robot, at_height(pixel, camera, i, thing.body.height_m));
    if (within(top, thing.body.half_m)) {
      colors[k] = kBodyTop;
    } else if (meets_square(top, into(robot, at_height(pixel, camera, i, 0)), thing.body.half_m)) {
      colors[k] = kBodySide;
    }
  }
}

void paint(const Arm& arm, const Footprint& pixel, const Point3& camera,
           std::array<Bgr, kSamples>& colors) {
  const Spot from{static_cast<float>(arm.from.x), static_cast<float>(arm.from.y)};
  const Spot axis{static_cast<float>(arm.to.x) - from.x, static_cast<float>(arm.to.y) - from.y};
  const float length2 = axis.x * axis.x + axis.y * axis.y;
  for (int i = 0; i < kSamples; ++i) {
    const Spot p = at_height(pixel, camera, i, static_cast<float>(arm.height_m));
    const float dx = p.x - from.x;
    const float dy = p.y - from.y;
    const float part = std::clamp((dx * axis.x + dy * axis.y) / length2, 0.0F, 1.0F);
    if (std::hypot(dx - part * axis.x, dy - part * axis.y) <= static_cast<float>(arm.radius_m))
      colors[static_cast<std::size_t>(i)] = kSkin;
  }
}

Bgr arena_color(const Arena& arena, std::span<const Point> corners, const Point3& camera,
                Point floor) {
  if (is_within(corners, floor)) return as_bgr(floor_at(arena, floor));
  // The ray comes down from the camera: where it first passes a wall's face below its top, it
  // ends there.
  const double dx = floor.x - camera.x;
  const double dy = floor.y - camera.y;
  for (const Wall& wall : arena.walls) {
    const double wx = wall.to.x - wall.from.x;
    const double wy = wall.to.y - wall.from.y;
    const double cross = dx * wy - dy * wx;
    if (std::abs(cross) < 1e-12) continue;
    const double ax = wall.from.x - camera.x;
    const double ay = wall.from.y - camera.y;
    const double along_ray = (ax * wy - ay * wx) / cross;
    const double along_wall = (ax * dy - ay * dx) / cross;
    const bool hit = along_wall >= 0 && along_wall <= 1 && along_ray > 0 && along_ray < 1;
    if (hit && camera.z * (1 - along_ray) <= arena.wall_height_m) return kWall;
  }
  return kOutside;
}

}  // namespace swarmsmith::film
