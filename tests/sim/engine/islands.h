#pragma once

#include <cstddef>

#include "sim/engine/internal/contact_solver.h"

namespace swarmsmith {

/// All movers as one island in which anything may touch anything.
inline Island everything(std::size_t movers, const Surroundings& surroundings) {
  Island island;
  const int n = static_cast<int>(movers);
  for (int i = 0; i < n; ++i) {
    island.movers.push_back(i);
    for (int j = i + 1; j < n; ++j)
      island.pairs.push_back({i, j});
    for (std::size_t w = 0; w < surroundings.walls.planes.size(); ++w)
      island.walls.push_back({i, static_cast<int>(w)});
    for (std::size_t o = 0; o < surroundings.obstacles.size(); ++o)
      island.obstacles.push_back({i, static_cast<int>(o)});
  }
  return island;
}

}  // namespace swarmsmith
