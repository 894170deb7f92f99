#pragma once

#include <vector>

namespace swarmsmith {

/// A mover and what it may touch.
struct Meeting {
  int mover = 0;
  int other = 0;  ///< a later mover, or the index of a wall or an obstacle

  friend bool operator==(const Meeting&, const Meeting&) = default;
};

/// Movers that may touch each other, or what stands around them, within the coming sub-steps. What
/// is not named here cannot touch.
struct Island {
  std::vector<int> movers;  ///< ascending
  /// Each in ascending order.
  std::vector<Meeting> pairs;
  std::vector<Meeting> walls;
  std::vector<Meeting> obstacles;

  friend bool operator==(const Island&, const Island&) = default;
};

}  // namespace swarmsmith
