#pragma once

#include "sim/robot/robot.h"

namespace swarmsmith {

/// A robot that nodes can drive: wider and slower than the RVR, its sensors in another order.
inline Robot rover() {
  Robot robot = rvr();
  robot.name = "rover";
  robot.drive.track_m = 0.2;
  robot.drive.max_speed_mps = 0.2;
  robot.proximity.rays_deg = {0, 45, 90, 135, 180, -135, -90, -45};
  return robot;
}

}  // namespace swarmsmith
