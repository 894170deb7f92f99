#pragma once

#include "sim/robot/point.h"

namespace swarmsmith {

/// Position of a robot's centre in metres and heading in radians, counter-clockwise from the x
/// axis, in (-pi, pi].
struct Pose {
  double x = 0;
  double y = 0;
  double theta = 0;

  Point position() const { return {x, y}; }
  friend bool operator==(const Pose&, const Pose&) = default;
};

}  // namespace swarmsmith
