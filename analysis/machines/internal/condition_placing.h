#pragma once

#include <cstddef>
#include <vector>

#include "analysis/machines/internal/edge_places.h"

namespace swarmsmith {

/// Where the boxes of conditions go, when the states have their places.

struct Placing {
  std::vector<PagePoint> boxes;  ///< centres, one an edge
  /// Sum of overlaps (much the most), of curves under boxes, crossings, crowded arrow heads, and of
  /// ways from the middles of the edges.
  double cost = 0;
  bool apart = false;  ///< neither boxes nor states overlap, and all are on the page
  bool clear = false;  ///< nor does a curve pass under a box or through a state
};

/// Tries places in a grid round the middle of each edge: first one edge after the other, then
/// again and again until nothing gets better or `kPlacingSweeps` are over. The same for the same
/// task, always.
Placing place_conditions(const PlacingTask& task);
inline constexpr int kPlacingSweeps = 8;
/// In so many orders.
inline constexpr int kPlacingOrders = 4;

/// Goes on from a placing of the same task, `kRefinements` rounds at most.
Placing refine_conditions(const PlacingTask& task, const Placing& placing);
inline constexpr int kRefinements = 5;

}  // namespace swarmsmith
