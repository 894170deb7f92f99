#pragma once

#include <cstddef>
#include <vector>

#include "analysis/machines/internal/edge_curve.h"

namespace swarmsmith {

/// Where the boxes of conditions go, when the states have their places.

struct PlacingTask {
  struct Edge {
    std::size_t source = 0;
    std::size_t target = 0;
    double width = 0;  ///< of the condition's box
    double height = 0;
  };
  std::vector<PagePoint> states;
  double radius = 0;  ///< of each state
  std::vector<Edge> edges;
  double left = 0;  ///< nothing may lie beyond these two
  double right = 0;
};

struct Placing {
  std::vector<PagePoint> boxes;  ///< centres, one an edge
  /// Sum of overlaps (much the most), of curves under boxes, crossings, crowded arrow heads, and of
  /// ways from the middles of the edges.
  double cost = 0;
  bool apart = false;  ///< neither boxes nor states overlap, and all are on the page
  bool clear = false;  ///< nor does a curve pass under a box or through a state
};

/// What an arrow head takes of an edge.
inline constexpr double kArrowLength = 2.2;
/// The least that is between boxes, and between a box and a state.
inline constexpr double kBoxGap = 1;

/// The curve of an edge whose box is at `box`, up to the arrow head.
EdgeCurve edge_curve(const PlacingTask& task, const PlacingTask::Edge& edge, PagePoint box);

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
