#pragma once

#include <vector>

#include "sim/engine/internal/form.h"
#include "sim/engine/internal/walls.h"

namespace swarmsmith {

/// The bodies that never move.
struct Surroundings {
  Walls walls;
  std::vector<FixedSolid> obstacles;
  double friction = kFriction;  ///< as in MoverKind::friction
};

Surroundings surroundings_of(const Arena& arena);

}  // namespace swarmsmith
