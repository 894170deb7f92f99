#pragma once

#include <vector>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/svg.h"
#include "analysis/figures/score_panels.h"

namespace swarmsmith {

/// The place and size of a group's box. It is vertical on a vertical axis, or horizontal on a
/// horizontal axis.
struct BoxPlace {
  double middle = 0;
  double half = 0;
  double end = 0;  ///< end of its band
  bool lies = false;

  /// The point on the page at a distance `aside` from the box's middle, and at a position on the
  /// axis.
  PagePoint at(double aside, double value) const {
    return lies ? PagePoint{value, middle + aside} : PagePoint{middle + aside, value};
  }
};

/// The width, in mm, of the counts of repeated values to the right of a vertical box; 0 if there
/// are none.
double count_room(const std::vector<double>& values);

/// The points of the values, in the order of the values.
std::vector<PagePoint> point_places(const std::vector<double>& values, const BoxPlace& place,
                                    const Axis& axis);

/// Draws the boxes' backgrounds and the lines between points, then whiskers, points, means, and
/// counts of repeated values. `places` has one element per group.
void draw_marks(Svg& svg, const ScorePanel& panel, const std::vector<BoxPlace>& places,
                const Axis& axis);

}  // namespace swarmsmith
