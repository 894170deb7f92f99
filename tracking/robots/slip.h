#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>

#include "tracking/robots/latency.h"

namespace swarmsmith {

/// How much a robot does of what its treads are commanded.
struct Gain {
  std::optional<double> gain;  ///< 1: all of it; none when it cannot be told
  bool is_against = false;     ///< a way that went back where ahead was told, by a known heading
  double error = 0;            ///< one standard error
  double seconds = 0;          ///< that it rests on
  std::string reason;          ///< why it cannot be told, a sentence without its subject
};

struct Slip {
  Gain way;
  Gain turn;
};

/// Ways and turns by the camera against those of the commands, by least squares over the times in
/// which commands did not change for so long that the treads had reached their speed, and in which
/// `is_free(from_s, to_s)`: who pushes a wall does not slip as on a free floor. Where straight ways
/// are compared, the turn that was told is small. Errors are of the sandwich over blocks of 2 s.
///
/// As latency_of: `commands` and `seen` are sorted and count time from the same instant. Commands
/// act `latency_s` later, give or take 0.15 s; at any time up to 0.5 s when that is not known.
Slip slip_of(std::span<const TimedCommand> commands, std::span<const Sample> seen,
             std::optional<double> latency_s, const std::function<bool(double, double)>& is_free);

}  // namespace swarmsmith
