#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "sim/control/readings.h"
#include "sim/robot/robot.h"

namespace swarmsmith {

using RayDirections = std::array<Vector2, kMostRingSensors>;

/// A ring of sensors in the form that the engine uses: unit vectors in the robot's frame. Only the
/// first `count` vectors are valid.
struct Ring {
  RayDirections directions{};
  std::size_t count = 0;
  std::size_t readings = kProximitySensors;  ///< `count`, but at least eight
  std::array<double, kMostRingSensors> angles_rad{};
  bool is_rvr = false;  ///< whether it has the angles of the RVR's ring
  /// Whether a ray that starts behind the face of a wall hits it at distance 0; otherwise it does
  /// not hit it.
  bool touches_walls = true;

  friend bool operator==(const Ring&, const Ring&) = default;
};

/// Takes at most kMostRingSensors angles; for the RVR's angles the result is its table, bit for
/// bit.
Ring ring_of(const RingAngles& angles_deg);

/// One per reading of the ring.
RingDirections directions_of(const Ring& ring);

/// The directions that control software assumes for the robot's proximity sensors, if they are not
/// the RVR's ring; for its light sensors, too, unless these have directions of their own.
std::optional<RingDirections> labels_of(const Robot& robot);

/// Whether the light sensors are not where control software assumes the proximity sensors to be.
bool has_own_lights(const Robot& robot);

}  // namespace swarmsmith
