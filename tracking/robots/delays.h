#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "tracking/robots/latency.h"

namespace swarmsmith {

/// The delays of single commands, in seconds. Used are commands that change the turning speed, with
/// steady turning before and after. Until the delay is over the robot turns at its old speed, which
/// changes the angle that it turns in all; the delay follows from this angle. The simulator's own
/// delay is subtracted (its treads accelerate to a turn at 55 rad/s^2, and are controlled at the
/// ends of steps of 10 ms), so that a simulation with these delays is as late as the robot. A late
/// command also holds up the commands after it, so these delays are not the ones to draw for each
/// command; see `drawn_delays`.
///
/// The arguments are as for slip_of; `turn_gain` is a result of slip_of. An unknown latency is
/// assumed to be at most 0.5 s.
std::vector<double> delays_of(std::span<const TimedCommand> commands, std::span<const Sample> seen,
                              std::optional<double> latency_s, double turn_gain,
                              const std::function<bool(double, double)>& is_free);

/// A delay with its probability.
struct DrawnDelay {
  double seconds = 0;
  double probability = 0;
};

/// The distribution of the delay to draw for each command, in steps of 10 ms. Commands come every
/// `period_s` and keep their order; those that changed something acted after `acted_s`. A command
/// has acted when it and all commands before it have arrived, so with the distributions F of the
/// drawn delays and E of `acted_s`, E(x) = F(x) F(x + period) ... and F(x) = E(x) / E(x + period).
/// Steps that may be due to chance are joined, and steps with a probability below 1 % are left out.
/// Empty without delays.
std::vector<DrawnDelay> drawn_delays(std::vector<double> acted_s, double period_s);

}  // namespace swarmsmith
