#pragma once

#include <cstdint>
#include <string>

namespace swarmsmith {

/// How often a robot detected its neighbours, from its own log and the camera's observations.
struct NeighboursSeen {
  std::int64_t there = 0;     ///< cycles with a neighbour well within range, summed over neighbours
  std::int64_t seen = 0;      ///< in how many of these the robot detected it
  std::int64_t phantoms = 0;  ///< neighbours in the log with no robot at that place
  double error = 0;           ///< one standard error of seen / there
  std::string reason;         ///< why there is no result; then all numbers are 0

  bool is_told() const { return reason.empty(); }
  double miss_rate() const {
    return there == 0 ? 0 : 1 - static_cast<double>(seen) / static_cast<double>(there);
  }

  friend bool operator==(const NeighboursSeen&, const NeighboursSeen&) = default;
};

}  // namespace swarmsmith
