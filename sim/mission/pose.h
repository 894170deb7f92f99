#pragma once

namespace swarmsmith {

/// A point of the arena's plane, metres; origin at the arena's centre.
struct Point {
  double x = 0;
  double y = 0;

  friend bool operator==(const Point&, const Point&) = default;
};

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
