#pragma once

#include <span>
#include <vector>

#include "sim/engine/internal/world.h"
#include "sim/mission/arena.h"

namespace swarmsmith {

/// The readings of the light sensors without noise (thesis 4.2.6).

/// A point in space, in metres; z above the floor.
struct SpacePoint {
  double x = 0;
  double y = 0;
  double z = 0;
};

/// Whether the segment from a robot's sensor to a light crosses a wall, an obstacle, an object or
/// another robot, each with its own height; touching one is enough.
bool is_occluded(const World& world, double wall_height_m, int robot, const SpacePoint& sensor,
                 const SpacePoint& light);

/// The front sensor, on the ring straight ahead, equally sensitive in all directions: E = sum of I
/// / d^2 over the lights that are not occluded, with I in candela and d the distance in space; then
/// clamped to [0, 16000] lux.
double front_light(const World& world, const Arena& arena, int robot);

/// The ring along the directions of the proximity sensors, as `chocolate` needs it: each light
/// counts I / d^2 times max(0, cosine of the horizontal angle between the sensor's direction and
/// the light), and 0 when it is directly above the sensor. Clamped to the same range.
///
/// For LightRing::Reading::Strength it gives the readings defined in robot.h, without noise and not
/// yet limited to 1; the direction of a light is then seen from the robot's axis. `room` is working
/// memory; `readings` has a place for each reading of the ring.
void light_ring(const World& world, const Arena& arena, int robot, std::vector<int>& room,
                std::span<double> readings);

}  // namespace swarmsmith
