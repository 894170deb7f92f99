#pragma once

#include "sim/mission/pose.h"
#include "sim/robot/outline.h"

namespace swarmsmith {

/// Solid things, which robots cannot drive through.

/// A thing that does not move.
struct Obstacle {
  Outline outline;
  Pose pose;
  double height_m = 0.3;  ///< decides which light and which rays it blocks

  friend bool operator==(const Obstacle&, const Obstacle&) = default;
};

/// A thing that can be pushed. It slides on the floor with a friction of at most `friction_N`, and
/// turns against the corresponding torque, friction_N times its mean radius.
struct MovableObject {
  Outline outline;
  Pose start;
  double mass_kg = 1;
  double friction_N = 1;
  double height_m = 0.3;

  friend bool operator==(const MovableObject&, const MovableObject&) = default;
};

/// A point of light in metres, `z_m` above the floor.
struct Light {
  double x_m = 0;
  double y_m = 0;
  double z_m = 0.75;
  double intensity_cd = 1000;  ///< candela: lux at a distance of one metre

  friend bool operator==(const Light&, const Light&) = default;
};

/// Height of walls (rvr-automode facts, section 7).
inline constexpr double kWallHeight_m = 0.08;

}  // namespace swarmsmith
