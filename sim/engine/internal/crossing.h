#pragma once

#include <limits>

#include "sim/engine/internal/form.h"
#include "sim/mission/pose.h"

namespace swarmsmith {

/// The part of a line p + t d that lies in a closed convex set: t from `from` to `to`. If the line
/// only touches the set, the stretch is one point.
struct Stretch {
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();

  bool empty() const { return !(from <= to); }
  /// Keeps only the part that also satisfies value + t * slope <= 0.
  void keep(double value, double slope);
};

/// The part of the line origin + t * along that lies in a solid; in coordinates of the arena.
Stretch stretch_in(const Form& form, const Body& at, Point origin, Point along);

}  // namespace swarmsmith
