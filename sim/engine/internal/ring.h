#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "sim/control/readings.h"
#include "sim/robot/robot.h"

namespace swarmsmith {

using RayDirections = RingDirections;

/// A ring of sensors as the engine wants it: unit vectors of the robot's frame, the first `count`.
struct Ring {
  RayDirections directions{};
  std::size_t count = 0;
  std::array<double, kProximitySensors> angles_rad{};
  /// A ray that starts behind the face of a wall has met it at 0; else it does not meet it.
  bool touches_walls = true;

  friend bool operator==(const Ring&, const Ring&) = default;
};

/// At most kProximitySensors angles; the RVR's become its table, to the last bit.
Ring ring_of(const RingAngles& angles_deg);

/// What control software takes the robot's proximity and light sensors for, where that is not the
/// RVR's ring.
std::optional<RayDirections> labels_of(const Robot& robot);

}  // namespace swarmsmith
