#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>

#include "tracking/robots/latency.h"

namespace swarmsmith {

/// The share of its commanded motion that a robot actually does.
struct Gain {
  std::optional<double> gain;  ///< 1: all of it; none if it cannot be determined
  bool is_against = false;     ///< drove backwards though ahead was commanded, with known heading
  double error = 0;            ///< one standard error
  double seconds = 0;          ///< total time of the motion that was used
  std::string reason;          ///< why it cannot be determined, a sentence without its subject
};

struct Slip {
  Gain way;
  Gain turn;
};

/// Compares distances and turns seen by the camera with the commanded ones, by least squares. Used
/// are times when the commands had been constant for long enough that the treads had reached their
/// speed, and when `is_free(from_s, to_s)`, because a robot that pushes a wall slips more than on a
/// free floor. Distances are only compared where the commanded turn is small. Errors are sandwich
/// estimates over blocks of 2 s.
///
/// As for latency_of, `commands` and `seen` are sorted and use the same clock. Commands act
/// `latency_s` later, with a tolerance of 0.15 s; if the latency is unknown, at any time up to 0.5
/// s later.
Slip slip_of(std::span<const TimedCommand> commands, std::span<const Sample> seen,
             std::optional<double> latency_s, const std::function<bool(double, double)>& is_free);

}  // namespace swarmsmith
