#include "sim/engine/internal/light.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "sim/control/readings.h"
#include "sim/engine/internal/crossing.h"

namespace swarmsmith {
namespace {

/// A segment in space; its points have t in [0, 1].
struct Segment {
  SpacePoint from;
  SpacePoint to;

  Point origin() const { return {from.x, from.y}; }
  Point along() const { return {to.x - from.x, to.y - from.y}; }
  /// Keeps only the part of the stretch that lies on the segment and at most this high.
  void keep(Stretch& stretch, double height_m) const {
    stretch.keep(-1, 1);
    stretch.keep(0, -1);
    stretch.keep(from.z - height_m, to.z - from.z);
  }
};

bool meets_wall(const Segment& segment, const WallPlane& wall, double height_m) {
  const double depth = wall.depth_of(segment.from.x, segment.from.y);
  const double depth_step = wall.depth_of(segment.to.x, segment.to.y) - depth;
  const double along = wall.along(segment.from.x, segment.from.y);
  const double along_step = wall.along(segment.to.x, segment.to.y) - along;
  Stretch stretch;
  stretch.keep(depth, depth_step);  // on the plane of the face
  stretch.keep(-depth, -depth_step);
  stretch.keep(-along, -along_step);  // between its ends
  stretch.keep(along - wall.length_m, along_step);
  segment.keep(stretch, height_m);
  return !stretch.empty();
}

bool meets_solid(const Segment& segment, const Form& form, const Body& at) {
  Stretch stretch = stretch_in(form, at, segment.origin(), segment.along());
  segment.keep(stretch, form.height_m);
  return !stretch.empty();
}

/// Position of a sensor of the ring, and its direction.
struct LightSensor {
  SpacePoint place;
  Point direction;
};

LightSensor sensor_towards(const Body& body, const LightRing& ring, Vector2 direction) {
  const Point world = {body.cos * direction.x - body.sin * direction.y,
                       body.sin * direction.x + body.cos * direction.y};
  return {.place = {.x = body.x + ring.out_m * world.x,
                    .y = body.y + ring.out_m * world.y,
                    .z = ring.height_m},
          .direction = world};
}

/// I / d^2.
double illuminance(const Light& light, const SpacePoint& at) {
  const double dx = light.x_m - at.x;
  const double dy = light.y_m - at.y;
  const double dz = light.z_m - at.z;
  return light.intensity_cd / (dx * dx + dy * dy + dz * dz);
}

double cosine_to(const Light& light, const LightSensor& sensor) {
  const double dx = light.x_m - sensor.place.x;
  const double dy = light.y_m - sensor.place.y;
  const double distance = std::sqrt(dx * dx + dy * dy);
  return distance > 0 ? (dx * sensor.direction.x + dy * sensor.direction.y) / distance : 0;
}

}  // namespace

bool is_occluded(const World& world, double wall_height_m, int robot, const SpacePoint& sensor,
                 const SpacePoint& light) {
  const Segment segment = {sensor, light};
  for (const WallPlane& wall : world.walls().planes) {
    if (meets_wall(segment, wall, wall_height_m)) return true;
  }
  for (const FixedSolid& obstacle : world.obstacles()) {
    if (meets_solid(segment, obstacle.form, obstacle.at)) return true;
  }
  for (int mover = 0; mover < world.movers(); ++mover) {
    if (mover != robot && meets_solid(segment, world.form(mover), world.body(mover))) return true;
  }
  return false;
}

double front_light(const World& world, const Arena& arena, int robot) {
  const LightSensor sensor = sensor_towards(world.body(robot), world.robot().light, {1, 0});
  double lux = 0;
  for (const Light& light : arena.lights) {
    if (light.intensity_cd == 0) continue;
    const SpacePoint place = {light.x_m, light.y_m, light.z_m};
    if (is_occluded(world, arena.wall_height_m, robot, sensor.place, place)) continue;
    lux += illuminance(light, sensor.place);
  }
  return std::clamp(lux, 0.0, kMostLight_lux);
}

namespace {

/// The distance within which a body of this height can hide the light from this place: only near
/// bodies can, because the line to the light rises.
double nearness_of_shade(const SpacePoint& sensor, const Light& light, double height_m) {
  const double dx = light.x_m - sensor.x;
  const double dy = light.y_m - sensor.y;
  const double distance = std::sqrt(dx * dx + dy * dy);
  if (light.z_m <= height_m) return distance;
  return std::max(0.0, (height_m - sensor.z) / (light.z_m - sensor.z) * distance);
}

/// The same as is_occluded, but checks only bodies that are near enough.
bool is_shaded(const World& world, double wall_height_m, int robot, const SpacePoint& sensor,
               const Light& light, std::vector<int>& room) {
  const Segment segment = {sensor, {light.x_m, light.y_m, light.z_m}};
  const double near_walls = nearness_of_shade(sensor, light, wall_height_m);
  for (const WallPlane& wall : world.walls().planes) {
    if (std::fabs(wall.depth_of(sensor.x, sensor.y)) <= near_walls &&
        meets_wall(segment, wall, wall_height_m)) {
      return true;
    }
  }
  for (const FixedSolid& obstacle : world.obstacles()) {
    if (meets_solid(segment, obstacle.form, obstacle.at)) return true;
  }
  double highest_m = world.robot().body.height_m;
  for (int object = world.robots(); object < world.movers(); ++object)
    highest_m = std::max(highest_m, world.form(object).height_m);
  const double near_movers = nearness_of_shade(sensor, light, highest_m);
  bool shaded = false;
  world.visit_near(robot, near_movers + world.largest_radius_m() + world.robot().light.out_m, room,
                   [&](int other) {
                     shaded = shaded || meets_solid(segment, world.form(other), world.body(other));
                   });
  return shaded;
}

/// The readings of LightRing::Reading::Strength.
void light_strengths(const World& world, const Arena& arena, int robot, std::vector<int>& room,
                     std::span<double> readings) {
  constexpr double kFarthest = 2.5;
  for_each_reading(readings.size(), [&](std::size_t i) { readings[i] = 0; });
  const Body& body = world.body(robot);
  const Ring& ring = world.light_ring();
  const SpacePoint sensor = {body.x, body.y, world.robot().light.height_m};
  for (const Light& light : arena.lights) {
    if (light.intensity_cd == 0) continue;
    const double dx = light.x_m - body.x;
    const double dy = light.y_m - body.y;
    const double dz = light.z_m - sensor.z;
    const double rho = std::sqrt(dx * dx + dy * dy + dz * dz) / light.intensity_cd;
    if (rho > kFarthest || is_shaded(world, arena.wall_height_m, robot, sensor, light, room)) {
      continue;
    }
    const double strength = exp(-2 * rho);
    const double bearing = atan2(dy * body.cos - dx * body.sin, dx * body.cos + dy * body.sin);
    for (std::size_t i = 0; i < ring.count; ++i) {
      const double angle = std::fabs(wrap_angle(bearing - ring.angles_rad[i]));
      readings[i] += strength * std::max(0.0, 1 - 2 * angle / kPi);
    }
  }
}

}  // namespace

void light_ring(const World& world, const Arena& arena, int robot, std::vector<int>& room,
                std::span<double> readings) {
  if (world.robot().light.reading == LightRing::Reading::Strength) {
    return light_strengths(world, arena, robot, room, readings);
  }
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const LightSensor sensor =
        sensor_towards(world.body(robot), world.robot().light, world.light_ring().directions[i]);
    double lux = 0;
    for (const Light& light : arena.lights) {
      const double cosine = cosine_to(light, sensor);
      if (light.intensity_cd == 0 || !(cosine > 0)) continue;
      const SpacePoint place = {light.x_m, light.y_m, light.z_m};
      if (is_occluded(world, arena.wall_height_m, robot, sensor.place, place)) continue;
      lux += illuminance(light, sensor.place) * cosine;
    }
    readings[i] = std::clamp(lux, 0.0, kMostLight_lux);
  }
}

}  // namespace swarmsmith
