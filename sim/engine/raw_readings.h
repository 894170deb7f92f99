#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/control/reference_model.h"
#include "sim/mission/arena.h"
#include "sim/mission/pose.h"

namespace swarmsmith {

/// Physical length of a proximity ray, metres (rvr-automode facts, section 3.1).
inline constexpr double kRayLength_m = 2.0;

/// What a robot's sensors would read at given poses without noise, for trajectory logs and tests.
struct RawReadings {
  /// Along the eight proximity directions, from the ray's start to the nearest wall or robot;
  /// +infinity where there is nothing within 2 m.
  std::array<double, kProximitySensors> distances_m{};
  Rgb floor;
  /// The robots nearer than 0.75 m, in the order of their numbers.
  std::vector<Neighbour> neighbours;

  /// The distances as the sensor reports them at range R: -infinity below 0.05 m, +infinity beyond
  /// R or where there is nothing.
  ProximityReadings proximity(double range_m) const;
};

/// Readings of all robots, one a pose.
std::vector<RawReadings> raw_readings(const Arena& arena, std::span<const Pose> robots);

}  // namespace swarmsmith
