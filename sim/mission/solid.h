#pragma once

#include <variant>
#include <vector>

#include "sim/mission/pose.h"

namespace swarmsmith {

/// Things that cannot be driven through. Outlines lie in the thing's own frame, origin at its
/// centre of mass, x forward.

struct CircleOutline {
  double radius_m = 0;

  friend bool operator==(const CircleOutline&, const CircleOutline&) = default;
};

struct BoxOutline {
  double length_m = 0;  ///< along x
  double width_m = 0;   ///< along y

  friend bool operator==(const BoxOutline&, const BoxOutline&) = default;
};

/// Convex, 3 to 8 corners, counter-clockwise.
struct PolygonOutline {
  std::vector<Point> corners;

  friend bool operator==(const PolygonOutline&, const PolygonOutline&) = default;
};

using Outline = std::variant<CircleOutline, BoxOutline, PolygonOutline>;

/// Stands where it is.
struct Obstacle {
  Outline outline;
  Pose pose;
  double height_m = 0.3;  ///< for the light that it keeps away, and the rays that meet it

  friend bool operator==(const Obstacle&, const Obstacle&) = default;
};

/// Can be pushed. It slides on the floor with a friction of at most `friction_N`, and turns with
/// the corresponding torque, friction_N times its mean radius.
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

/// Side of the RVR's square body, metres (argos3-rvr; rvr-automode facts, section 2).
inline constexpr double kBodySide_m = 0.286;
/// Its height; what the walls have (rvr-automode facts, sections 2 and 7).
inline constexpr double kBodyHeight_m = 0.114;
inline constexpr double kWallHeight_m = 0.08;
/// Where proximity and lidar rays run above the floor; they pass over obstacles and objects that
/// are lower (rvr-automode facts, sections 3.1 and 3.4).
inline constexpr double kProximityHeight_m = 0.032;
inline constexpr double kLidarHeight_m = 0.04;

}  // namespace swarmsmith
