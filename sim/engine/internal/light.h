#pragma once

#include <vector>

#include "sim/engine/internal/world.h"
#include "sim/mission/arena.h"

namespace swarmsmith {

/// What the light sensors read, without noise (thesis 4.2.6).

/// A point of space, metres; z above the floor.
struct SpacePoint {
  double x = 0;
  double y = 0;
  double z = 0;
};

/// Whether the segment from a robot's sensor to a light meets a wall, an obstacle, an object or
/// another robot, each as high as it is; a touch is enough.
bool is_occluded(const World& world, double wall_height_m, int robot, const SpacePoint& sensor,
                 const SpacePoint& light);

/// The front sensor, on the ring straight ahead, as sensitive in all directions:
/// E = sum of I / d^2 over the lights that are not occluded, I in candela, d the distance in space;
/// then clamped to [0, 16000] lux.
double front_light(const World& world, const Arena& arena, int robot);

/// The ring at the directions of the proximity sensors, as `chocolate` wants it: each
/// light counts I / d^2 times max(0, cosine of the horizontal angle between the sensor's direction
/// and the light), nothing when it stands right above the sensor. Clamped alike.
///
/// Of LightRing::Reading::Strength, as robot.h has it, without noise and not yet cut to 1; the
/// light is looked for from the robot's axis. `room` is room to work in.
LightReadings light_ring(const World& world, const Arena& arena, int robot, std::vector<int>& room);

}  // namespace swarmsmith
