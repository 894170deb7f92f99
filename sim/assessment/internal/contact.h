#pragma once

#include <span>

#include "sim/mission/arena.h"
#include "sim/mission/pose.h"

namespace swarmsmith::assessment {

/// Gap between the bodies of two robots, metres: the widest that the four face directions show
/// (separating axes), negative when they overlap. Between two corners it may be 0.71 of the
/// distance.
double body_gap(const Pose& a, const Pose& b);

/// Gap between a robot's body and the line of a wall, metres.
double wall_gap(const Pose& robot, const Wall& wall);

/// Gaps up to this one are contacts. Robots that push each other overlap a little; those that let
/// go of each other between two looks may be this far apart.
inline constexpr double kContactGap_m = 0.002;

/// Whether any robot touches another one or a wall of the convex arena.
bool any_contact(std::span<const Pose> robots, const Arena& arena);

}  // namespace swarmsmith::assessment
