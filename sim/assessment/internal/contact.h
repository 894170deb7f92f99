#pragma once

#include <span>

#include "sim/mission/arena.h"
#include "sim/mission/footprint.h"
#include "sim/mission/pose.h"

namespace swarmsmith::assessment {

/// Gap between two bodies, metres: the widest gap along the normals of their faces (separating
/// axes), negative when they overlap. Between two corners it may be as small as 0.71 of the
/// distance. For two circles it is the distance.
double body_gap(const Footprint& a, const Footprint& b);

/// Gap between a robot's body and the line of a wall, metres.
double wall_gap(const Footprint& robot, const Wall& wall);

/// Gaps up to this count as contacts. Robots that push each other overlap a little; robots that
/// separate between two observations may be this far apart.
inline constexpr double kContactGap_m = 0.002;

/// Whether any robot of this outline touches another one or a wall of the convex arena.
bool any_contact(const Outline& outline, std::span<const Pose> robots, const Arena& arena);

}  // namespace swarmsmith::assessment
