#pragma once

#include <vector>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/svg.h"
#include "analysis/figures/score_panels.h"

namespace swarmsmith {

/// Where a group's box is, and how wide.
struct BoxPlace {
  double x = 0;
  double half = 0;
  double right = 0;  ///< where its band ends
};

/// The room that counts of repeated values need at the right of a box, mm; 0 where none are
/// written.
double count_room(const std::vector<double>& values);

/// Box, whiskers, points, mean, and counts of values that repeat.
void draw_marks(Svg& svg, const ScoreGroup& group, const BoxPlace& place, const Axis& y);

}  // namespace swarmsmith
