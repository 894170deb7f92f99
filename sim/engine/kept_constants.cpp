#include "sim/engine/kept_constants.h"

namespace swarmsmith {

std::optional<KeptConstants> kept_constants(const Robot& robot) {
  const Outline& outline = robot.body.outline;
  if (robot == rvr() || robot != rvr_with(outline)) return std::nullopt;
  return KeptConstants{.mass_kg = robot.body.mass_kg,
                       .drive_N = robot.drive.max_force_N,
                       .treads_m = robot.drive.track_m,
                       .ground_sensor_m = robot.ground.places.front().x,
                       .height_m = robot.body.height_m,
                       .neighbours_m = robot.neighbours.range_m};
}

}  // namespace swarmsmith
