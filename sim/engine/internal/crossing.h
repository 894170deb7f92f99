#pragma once

#include <limits>

#include "sim/engine/internal/form.h"
#include "sim/mission/pose.h"

namespace swarmsmith {

/// The part of a line p + t d that lies in a closed convex set: t from `from` to `to`. A line that
/// only touches the set has a stretch of one point.
struct Stretch {
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();

  bool empty() const { return !(from <= to); }
  /// Keeps what also satisfies value + t * slope <= 0.
  void keep(double value, double slope);
};

/// The part of the line origin + t * along that lies in a solid; coordinates of the arena.
Stretch stretch_in(const Form& form, const Body& at, Point origin, Point along);

}  // namespace swarmsmith
