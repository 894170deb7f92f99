#pragma once

#include <vector>

namespace swarmsmith {

/// A mover and another body that it may touch.
struct Meeting {
  int mover = 0;
  int other = 0;  ///< a later mover, or the index of a wall or an obstacle

  friend bool operator==(const Meeting&, const Meeting&) = default;
};

/// Movers that may touch each other, walls or obstacles within the coming sub-steps. Bodies that
/// are not listed here cannot touch.
struct Island {
  std::vector<int> movers;  ///< ascending
  /// Each in ascending order.
  std::vector<Meeting> pairs;
  std::vector<Meeting> walls;
  std::vector<Meeting> obstacles;

  friend bool operator==(const Island&, const Island&) = default;
};

}  // namespace swarmsmith
