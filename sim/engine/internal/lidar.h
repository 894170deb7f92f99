#pragma once

#include <span>

#include "sim/control/lidar_clustering.h"
#include "sim/engine/internal/noise_stream.h"
#include "sim/engine/internal/sight.h"
#include "sim/engine/internal/world.h"

namespace swarmsmith {

/// The lidar (thesis 4.2.10): 719 rays from the robot's axis, the first straight ahead, the others
/// counter-clockwise. The rays that hit an object are those between the angles of its edges, so a
/// scan costs about one division per ray.

/// Limits of its readings: -infinity below, +infinity beyond.
inline constexpr double kLidarLeast_m = 0.10;
inline constexpr double kLidarMost_m = 12;
/// Radius of a robot's lidar as other lidars see it: an upright cylinder on the robot's axis
/// (thesis facts, section 4).
inline constexpr double kTurretRadius_m = 0.035;

/// Physical distances along the rays to walls, other robots, obstacles and objects, taking their
/// heights into account; +infinity for rays that hit nothing. `ranges_m` holds kLidarRays values,
/// which are all replaced. Returns true if all distances are certain to be within the lidar's
/// limits.
bool scan_surroundings(const World& world, int robot, std::span<double> ranges_m);

/// The same if only the turrets of the other robots are visible, without the robots that are
/// hidden.
void scan_turrets(const World& world, const Sight& sight, int robot, std::span<double> ranges_m);

/// Converts distances to readings: applies the limits, adds uniform noise of this half-width to
/// finite distances, and applies the limits again.
void add_lidar_noise(std::span<double> ranges_m, double half_width_m, const NoiseStream& noise,
                     std::int64_t cycle);

}  // namespace swarmsmith
