#pragma once

#include <vector>

#include "sim/engine/internal/rays.h"
#include "sim/engine/internal/world.h"

namespace swarmsmith {

/// What a robot's ideal sensors meet in the world as it is.

/// Distances along the proximity directions to the nearest wall, robot, obstacle or object; exact
/// up to `range_m`, at least as long beyond it.
RayDistances ray_distances(const World& world, int robot, double range_m);

/// The robots nearer than 0.75 m as an omnidirectional camera sees them, in the order of their
/// numbers; replaces what was in `found`.
void find_neighbours(const World& world, int robot, std::vector<Neighbour>& found);

}  // namespace swarmsmith
