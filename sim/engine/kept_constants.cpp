#include "sim/engine/kept_constants.h"

#include "base/overloaded.h"
#include "sim/control/reference_model.h"
#include "sim/engine/internal/body.h"
#include "sim/engine/internal/robot_senses.h"
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

std::optional<KeptConstants> kept_constants(const Outline& body) {
  if (body == Outline(BoxOutline{kBodySide_m, kBodySide_m})) return std::nullopt;
  return KeptConstants{.mass_kg = kMass_kg,
                       .drive_N = kMaxForce_N,
                       .treads_m = kTreadDistance_m,
                       .ground_sensor_m = kGroundSensorAhead_m,
                       .ground_sensor_is_outside = !has_ground_sensor_inside(body),
                       .height_m = kBodyHeight_m,
                       .neighbours_m = kNeighbourRange_m};
}

}  // namespace swarmsmith
