#pragma once

#include <vector>

#include "sim/control/reference_model.h"
#include "sim/mission/pose.h"

namespace swarmsmith {

/// The sensors of the robot (thesis 4.2), one bit each.
enum class Sensor : unsigned {
  GroundColor = 1U << 0U,
  Velocity = 1U << 1U,
  Accelerometer = 1U << 2U,
  Gyroscope = 1U << 3U,
  Imu = 1U << 4U,
  FrontLight = 1U << 5U,
  LightRing = 1U << 6U,
  Locator = 1U << 7U,
  Quaternion = 1U << 8U,
  Proximity = 1U << 9U,
  Lidar = 1U << 10U,
  Neighbours = 1U << 11U,
};

/// A set of sensors.
class Sensors {
 public:
  constexpr Sensors() = default;
  constexpr Sensors(Sensor sensor)
      : bits_(static_cast<unsigned>(sensor)) {}  // NOLINT: a set of one
  static constexpr Sensors all() { return Sensors(0xfffU); }

  constexpr bool has(Sensor sensor) const { return (bits_ & static_cast<unsigned>(sensor)) != 0; }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr Sensors without(Sensor sensor) const {
    return Sensors(bits_ & ~static_cast<unsigned>(sensor));
  }
  constexpr friend Sensors operator|(Sensors a, Sensors b) { return Sensors(a.bits_ | b.bits_); }
  friend bool operator==(const Sensors&, const Sensors&) = default;

 private:
  explicit constexpr Sensors(unsigned bits) : bits_(bits) {}
  unsigned bits_ = 0;
};
constexpr Sensors operator|(Sensor a, Sensor b) {
  return Sensors(a) | Sensors(b);
}

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

/// The readings of one robot in one control cycle. Sensors that were not requested keep their
/// earlier readings.
struct Readings {
  Rgb ground_color;                 ///< thesis 4.2.1
  Vector3 velocity_mps;             ///< eq. 4.3, in axes fixed at the start pose
  Vector3 acceleration_g;           ///< eq. 4.7
  Vector3 spin_radps;               ///< eq. 4.9
  Orientation orientation;          ///< thesis 4.2.5, in the frame of the arena
  double front_light_lux = 0;       ///< thesis 4.2.6
  std::vector<double> light_lux;    ///< the ring of `chocolate`, or the robot's own
  Point position_m;                 ///< eq. 4.10, from the start, axes of the arena
  Quaternion rotation;              ///< eq. 4.11, from the start
  std::vector<double> proximity_m;  ///< thesis 4.2.9
  std::vector<double> lidar_m;      ///< thesis 4.2.10, 719 rays, counter-clockwise from the head
  /// Thesis 5.1. For a radio, all packets that it remembers; those of this cycle are at the end.
  std::vector<Neighbour> neighbours;
  int neighbour_count = 0;  ///< neighbours that were seen or heard in this cycle
};

/// The sensors of a simulated robot in a control cycle: those that control software may use, and
/// all others. Each sensor is computed when first requested.
class SimulatedSenses : public Senses {
 public:
  /// The readings of these sensors in this cycle; sensors that were already read are not read
  /// again.
  ///
  /// The accelerometer and the gyroscope use the difference from their previous reading: request
  /// them in every cycle or in none.
  virtual const Readings& read(Sensors sensors) = 0;
};

}  // namespace swarmsmith
