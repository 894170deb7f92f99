#pragma once

#include "sim/mission/arena.h"

namespace swarmsmith {

/// From a point, inside or outside, to the nearest place of a wall; infinite without walls.
double distance_to_walls(const Arena& arena, Point point);

}  // namespace swarmsmith
