#pragma once

#include "sim/mission/arena.h"

namespace swarmsmith {

/// The distance from a point, inside or outside, to the nearest wall; infinite without walls.
double distance_to_walls(const Arena& arena, Point point);

}  // namespace swarmsmith
