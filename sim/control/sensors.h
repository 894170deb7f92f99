#pragma once

#include "sim/control/controller.h"
#include "sim/control/flavour.h"

namespace swarmsmith {

/// What the robot's sensors can say (thesis 4.2), one bit each.
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
  constexpr friend Sensors operator|(Sensors a, Sensors b) { return Sensors(a.bits_ | b.bits_); }
  friend bool operator==(const Sensors&, const Sensors&) = default;

 private:
  explicit constexpr Sensors(unsigned bits) : bits_(bits) {}
  unsigned bits_ = 0;
};
constexpr Sensors operator|(Sensor a, Sensor b) {
  return Sensors(a) | Sensors(b);
}

/// What a controller may ask for, whatever it senses and draws: GroundColor, LightRing, Proximity
/// and Neighbours. States of a machine that no transition leads to count for nothing.
Sensors sensors_of(const Controller& controller, const Flavour& flavour);

}  // namespace swarmsmith
