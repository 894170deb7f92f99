#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tracking/robots/latency.h"

namespace swarmsmith {

/// A robot's commands and the samples of its positions, both with times from the start of the run.
struct ToldAndSeen {
  std::vector<TimedCommand> commands;
  std::span<const Sample> seen;
};

/// How fast a film plays, measured with the robots' clocks.
struct FilmRate {
  /// Seconds on the robots' clocks per second of the film: below 1 if the film is too long. None if
  /// it cannot be determined.
  std::optional<double> rate;
  double off_s = 0;    ///< error of the film's clock at the end of the commands
  std::string reason;  ///< why it cannot be determined
};

/// Stretches the film's clock by factors from a half to two, and shifts it by possible latencies,
/// until the turns and distances of the robots agree best with the commands of their treads. The
/// best factor is reported if it is far likelier than factors 1 % larger or smaller; for a film
/// that is far off, if it is far likelier than 1 and than factors half way to 1. The run's start,
/// `start_s` on the film's clock, was read either from this clock, and is then stretched like the
/// film, or from a correct clock.
FilmRate film_rate(std::span<const ToldAndSeen> robots, double start_s = 0);

}  // namespace swarmsmith
