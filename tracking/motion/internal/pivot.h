#pragma once

#include <optional>
#include <span>

#include "tracking/motion/internal/travel.h"

namespace swarmsmith {

/// The point about which a robot turns when it turns on the spot; the spin calibrated this point as
/// the robot's centre. Given as the position of the measured point relative to it, in the axes of
/// the measured pose.
struct Pivot {
  double ahead_m = 0;
  double aside_m = 0;  ///< to the left
  double sigma_m = 0;
};

/// Each single step with a turn has a point that does not move. In bends this point is to the side
/// of the robot, and skidding moves it, too: every body that turns while it drives skids in its old
/// direction. In turns on the spot it is always the same point, for turns to the left and to the
/// right. So the pivot is the position where most of these points are, if turns in both directions
/// have it, or if it is not to the side of the measured point. Nothing if the robot hardly turned
/// on the spot.
std::optional<Pivot> pivot_of(std::span<const TravelStep> steps);

}  // namespace swarmsmith
