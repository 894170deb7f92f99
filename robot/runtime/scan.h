#pragma once

#include <array>
#include <optional>
#include <string>

#include "robot/transport/messages.h"
#include "sim/control/lidar_clustering.h"

namespace swarmsmith {

/// Distances along our rays, +infinity where nothing was met.
using RayRanges = std::array<double, kLidarRays>;

/// A scan of any length, direction and number of turns as distances along our rays: each takes the
/// value that is nearest in angle, at most half an increment away. 0, NaN and what is outside of
/// the scan's limits is nothing met. `turn_rad`: the angle of the lidar's own zero from the robot's
/// head, counter-clockwise.
///
/// Returns what is wrong with the scan, if anything; then `ranges_m` is not of use.
std::optional<std::string> resample(const ScanMessage& scan, double turn_rad, RayRanges& ranges_m);

}  // namespace swarmsmith
