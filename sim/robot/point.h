#pragma once

namespace swarmsmith {

/// A point of the plane in metres: in the arena, whose centre is the origin, or in a robot's frame.
struct Point {
  double x = 0;
  double y = 0;

  friend bool operator==(const Point&, const Point&) = default;
};

}  // namespace swarmsmith
