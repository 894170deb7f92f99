#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "analysis/machines/internal/edge_curve.h"

namespace swarmsmith {

/// Possible places for a condition's box, and the conflicts between two places.

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
  double left = 0;  ///< everything must lie between these two
  double right = 0;
};

/// The length of an edge that its arrow head covers.
inline constexpr double kArrowLength = 2.2;
/// The minimum distance between two boxes, and between a box and a state.
inline constexpr double kBoxGap = 1;

/// The curve of an edge whose box is at `box`, up to the arrow head.
EdgeCurve edge_curve(const PlacingTask& task, const PlacingTask::Edge& edge, PagePoint box);

/// The cost of an overlap. The unit of all costs is 1 mm of distance from the middle of an edge.
inline constexpr double kOverlap = 2000;

/// Curves are approximated by this number of straight segments.
inline constexpr std::size_t kSegments = 10;

/// A place for an edge's box, with its curve and cost.
struct EdgePlace {
  PageBox box;
  std::array<PagePoint, kSegments + 1> line;  ///< the curve as a polyline
  PageBox around;                             ///< bounding box of the curve
  double alone = 0;                           ///< cost without other edges
  bool apart = true;
  bool clear = true;
};

/// The possible places for one edge, best first, on a grid around the middle of its chord.
std::vector<EdgePlace> places_of(const PlacingTask& task, const PlacingTask::Edge& edge);

/// The length of a curve that passes under the box of another place, mm.
double length_under(const EdgePlace& curve, const EdgePlace& other);

int crossings(const EdgePlace& a, const EdgePlace& b);

/// The number of points of curve `a` that lie beside curve `b`.
int points_alongside(const EdgePlace& a, const EdgePlace& b);

}  // namespace swarmsmith
