#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "analysis/machines/internal/edge_curve.h"

namespace swarmsmith {

/// Places where the box of a condition may stand, and how two of them get on.

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

/// What an arrow head takes of an edge.
inline constexpr double kArrowLength = 2.2;
/// The least that is between boxes, and between a box and a state.
inline constexpr double kBoxGap = 1;

/// The curve of an edge whose box is at `box`, up to the arrow head.
EdgeCurve edge_curve(const PlacingTask& task, const PlacingTask::Edge& edge, PagePoint box);

/// Costs are in millimetres of way from the middle of an edge, as it were; this is that of two
/// things that must not overlap.
inline constexpr double kOverlap = 2000;

/// Curves are looked at as so many straight pieces.
inline constexpr std::size_t kSegments = 10;

/// A place of an edge's box, and what follows from it.
struct EdgePlace {
  PageBox box;
  std::array<PagePoint, kSegments + 1> line;  ///< the curve as a polyline
  PageBox around;                             ///< the curve
  double alone = 0;                           ///< the cost, without other edges
  bool apart = true;
  bool clear = true;
};

/// The places of one edge, the best ones first, in a grid round the middle of its chord.
std::vector<EdgePlace> places_of(const PlacingTask& task, const PlacingTask::Edge& edge);

/// How much of a curve passes under another one's box, mm.
double length_under(const EdgePlace& curve, const EdgePlace& other);

int crossings(const EdgePlace& a, const EdgePlace& b);

/// How many points of a curve lie beside another one.
int points_alongside(const EdgePlace& a, const EdgePlace& b);

}  // namespace swarmsmith
