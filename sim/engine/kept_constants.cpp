#include "sim/engine/kept_constants.h"

#include "base/overloaded.h"
#include "sim/mission/polygon.h"

namespace swarmsmith {
namespace {

bool has_ground_sensor_inside(const Outline& body) {
  return std::visit(
      Overloaded{[](const CircleOutline& circle) { return circle.radius_m > kGroundSensorAhead_m; },
                 [](const BoxOutline& box) { return box.length_m / 2 > kGroundSensorAhead_m; },
                 [](const PolygonOutline& polygon) {
                   return is_within(polygon.corners, {kGroundSensorAhead_m, 0});
                 }},
      body);
}

}  // namespace

std::optional<KeptConstants> kept_constants(const Robot& robot) {
  const Outline& outline = robot.body.outline;
  if (robot == rvr() || robot != rvr_with(outline)) return std::nullopt;
  return KeptConstants{.mass_kg = robot.body.mass_kg,
                       .drive_N = robot.drive.max_force_N,
                       .treads_m = robot.drive.track_m,
                       .ground_sensor_m = robot.ground.places.front().x,
                       .ground_sensor_is_outside = !has_ground_sensor_inside(outline),
                       .height_m = robot.body.height_m,
                       .neighbours_m = robot.neighbours.range_m};
}

}  // namespace swarmsmith
