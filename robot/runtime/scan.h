#pragma once

#include <array>
#include <optional>
#include <string>

#include "robot/transport/messages.h"
#include "sim/control/lidar_clustering.h"

namespace swarmsmith {

/// Distances along the rays of lidar_directions(), +infinity for rays without a hit.
using RayRanges = std::array<double, kLidarRays>;

/// Converts a scan of any length, direction and number of turns to distances along these rays: each
/// gets the value nearest in angle, at most half an increment away. 0, NaN and values outside the
/// scan's limits count as no hit. `turn_rad` is the angle of the lidar's zero from the robot's
/// head, counter-clockwise.
///
/// Returns the error in the scan, if there is one; `ranges_m` is then unusable.
std::optional<std::string> resample(const ScanMessage& scan, double turn_rad, RayRanges& ranges_m);

}  // namespace swarmsmith
