#pragma once

#include <vector>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/svg.h"
#include "analysis/figures/score_panels.h"

namespace swarmsmith {

/// Where a group's box is, and how wide. It stands on an axis that goes up, or lies on one that
/// goes right.
struct BoxPlace {
  double middle = 0;
  double half = 0;
  double end = 0;  ///< where its band ends
  bool lies = false;

  /// On the page: aside from its middle, at a place of the axis.
  PagePoint at(double aside, double value) const {
    return lies ? PagePoint{value, middle + aside} : PagePoint{middle + aside, value};
  }
};

/// The room that counts of repeated values need at the right of a box that stands, mm; 0 where none
/// are written.
double count_room(const std::vector<double>& values);

/// The points of the values, in their order.
std::vector<PagePoint> point_places(const std::vector<double>& values, const BoxPlace& place,
                                    const Axis& axis);

/// The boxes' grounds, lines between points, then whiskers, points, means, and counts of values
/// that repeat. A place a group.
void draw_marks(Svg& svg, const ScorePanel& panel, const std::vector<BoxPlace>& places,
                const Axis& axis);

}  // namespace swarmsmith
