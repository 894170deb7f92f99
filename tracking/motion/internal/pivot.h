#pragma once

#include <optional>
#include <span>

#include "tracking/motion/internal/travel.h"

namespace swarmsmith {

/// Where a robot turns about when it turns on the spot: the point that its spin calibrated as its
/// centre. As the place of the measured point from there, in the axes of the measured pose.
struct Pivot {
  double ahead_m = 0;
  double aside_m = 0;  ///< to the left
  double sigma_m = 0;
};

/// From single steps with a turn: each has a point that rests. In bends that point lies to the
/// side, and a body that skids out of its old direction, as all do that turn while they drive,
/// moves it, too. But in turns on the spot it is one and the same, to the left and to the right. So
/// it is the point where most of these points lie, if turns both ways have it, or if it is the
/// measured point's own side. Nothing where the robot hardly turned on the spot.
std::optional<Pivot> pivot_of(std::span<const TravelStep> steps);

}  // namespace swarmsmith
