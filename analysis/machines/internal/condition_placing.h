#pragma once

#include <cstddef>
#include <vector>

#include "analysis/machines/internal/edge_places.h"

namespace swarmsmith {

/// Finds places for the boxes of conditions; the states have their places already.

struct Placing {
  std::vector<PagePoint> boxes;  ///< centres, one per edge
  /// Sum of the costs of overlaps (by far the largest), curves under boxes, crossings, crowded
  /// arrow heads, and distances from the middles of the edges.
  double cost = 0;
  bool apart = false;  ///< boxes and states do not overlap, and all are on the page
  bool clear = false;  ///< also, no curve passes under a box or through a state
};

/// Tries places on a grid around the middle of each edge: first one edge after the other, then all
/// edges repeatedly until nothing improves or `kPlacingSweeps` are done. Deterministic.
Placing place_conditions(const PlacingTask& task);
inline constexpr int kPlacingSweeps = 8;
/// Number of different orders of edges that are tried.
inline constexpr int kPlacingOrders = 4;

/// Improves a placing of the same task, in at most `kRefinements` rounds.
Placing refine_conditions(const PlacingTask& task, const Placing& placing);
inline constexpr int kRefinements = 5;

}  // namespace swarmsmith
