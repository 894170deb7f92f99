#pragma once

#include <vector>

#include "sim/control/reference_model.h"
#include "sim/control/sensors.h"
#include "sim/mission/pose.h"

namespace swarmsmith {

struct Vector3 {
  double x = 0;
  double y = 0;
  double z = 0;

  friend bool operator==(const Vector3&, const Vector3&) = default;
};

/// Rotation w + xi + yj + zk of length 1.
struct Quaternion {
  double w = 1;
  double x = 0;
  double y = 0;
  double z = 0;

  friend bool operator==(const Quaternion&, const Quaternion&) = default;
};

struct Orientation {
  double pitch_rad = 0;
  double roll_rad = 0;
  double yaw_rad = 0;

  friend bool operator==(const Orientation&, const Orientation&) = default;
};

/// One robot's readings of one control cycle: those of the sensors that were asked for; the others
/// keep what they had.
struct Readings {
  Rgb ground_color;                   ///< thesis 4.2.1
  Vector3 velocity_mps;               ///< eq. 4.3, in axes fixed at the start pose
  Vector3 acceleration_g;             ///< eq. 4.7
  Vector3 spin_radps;                 ///< eq. 4.9
  Orientation orientation;            ///< thesis 4.2.5, in the frame of the arena
  double front_light_lux = 0;         ///< thesis 4.2.6
  LightReadings light_lux{};          ///< the ring of `chocolate`
  Point position_m;                   ///< eq. 4.10, from the start, axes of the arena
  Quaternion rotation;                ///< eq. 4.11, from the start
  ProximityReadings proximity_m{};    ///< thesis 4.2.9
  std::vector<double> lidar_m;        ///< thesis 4.2.10, 719 rays, counter-clockwise from the head
  std::vector<Neighbour> neighbours;  ///< thesis 5.1
};

}  // namespace swarmsmith
