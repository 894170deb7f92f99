#pragma once

#include <cstdint>
#include <string>

namespace swarmsmith {

/// How often a robot knew of its neighbours, by its own log beside what the camera saw.
struct NeighboursSeen {
  std::int64_t there = 0;     ///< chances: a neighbour well within range, in one control cycle
  std::int64_t seen = 0;      ///< of those
  std::int64_t phantoms = 0;  ///< neighbours in the log with no robot at that place
  double error = 0;           ///< one standard error of seen / there
  std::string reason;         ///< why it cannot be told; then all else is 0

  bool is_told() const { return reason.empty(); }
  double miss_rate() const {
    return there == 0 ? 0 : 1 - static_cast<double>(seen) / static_cast<double>(there);
  }

  friend bool operator==(const NeighboursSeen&, const NeighboursSeen&) = default;
};

}  // namespace swarmsmith
