#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "tracking/robots/latency.h"

namespace swarmsmith {

/// How late single commands acted, seconds: those that changed the turning after a steady time and
/// were steady after it. The angle that was turned until then lacks what the robot turned at the
/// old speed; of the time that follows, the simulator's own is taken off (its treads come to a turn
/// at 55 rad/s^2, and are steered at the ends of steps of 10 ms), so that the simulator with these
/// delays is as late as the robot. One that comes late delays those after it, so they are not what
/// is drawn for a command; see `drawn_delays`.
///
/// As slip_of; `turn_gain` is its result. A latency that is not known is up to 0.5 s.
std::vector<double> delays_of(std::span<const TimedCommand> commands, std::span<const Sample> seen,
                              std::optional<double> latency_s, double turn_gain,
                              const std::function<bool(double, double)>& is_free);

/// A delay with its probability.
struct DrawnDelay {
  double seconds = 0;
  double probability = 0;
};

/// The law of what is drawn for each command, in steps of 10 ms, when commands come each
/// `period_s`, keep their order, and those that changed something acted after `acted_s`: a command
/// has acted by then when it and all before it have arrived, E(x) = F(x) F(x + period) ..., so F(x)
/// = E(x) / E(x + period). Steps that chance can have made are joined, those that hold less than
/// one in a hundred are left out. Empty for nothing.
std::vector<DrawnDelay> drawn_delays(std::vector<double> acted_s, double period_s);

}  // namespace swarmsmith
