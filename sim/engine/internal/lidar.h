#pragma once

#include <span>

#include "sim/control/lidar_clustering.h"
#include "sim/engine/internal/noise_stream.h"
#include "sim/engine/internal/sight.h"
#include "sim/engine/internal/world.h"

namespace swarmsmith {

/// The lidar (thesis 4.2.10): 719 rays from the robot's axis, first straight ahead,
/// counter-clockwise. Each thing in view is met by the rays between the angles of its edges, so
/// that a scan costs about one division a ray.

/// Its readings are -infinity below, +infinity beyond.
inline constexpr double kLidarLeast_m = 0.10;
inline constexpr double kLidarMost_m = 12;
/// A lidar as another robot's lidar sees it, an upright cylinder on the robot's axis (thesis facts,
/// section 4).
inline constexpr double kTurretRadius_m = 0.035;

/// Physical distances along the rays to walls, other robots, obstacles and objects, each whatever
/// its height, +infinity where nothing is met. `ranges_m` holds kLidarRays values, all replaced.
/// Says whether the lidar's limits surely leave all of them as they are.
bool scan_surroundings(const World& world, int robot, std::span<double> ranges_m);

/// The same where only the other robots' turrets are seen, but for those that are hidden.
void scan_turrets(const World& world, const Sight& sight, int robot, std::span<double> ranges_m);

/// From distances to readings: limits, uniform noise of this half-width on what is finite, limits
/// again.
void add_lidar_noise(std::span<double> ranges_m, double half_width_m, const NoiseStream& noise,
                     std::int64_t cycle);

}  // namespace swarmsmith
