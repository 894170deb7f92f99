#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tracking/robots/latency.h"

namespace swarmsmith {

/// What a robot was told, and where the camera saw it, both from the start of the run on.
struct ToldAndSeen {
  std::vector<TimedCommand> commands;
  std::span<const Sample> seen;
};

/// How fast a film plays, by the robots' clocks.
struct FilmRate {
  /// Seconds of the robots in one second of the film: below 1 where the film is too long. None when
  /// it cannot be told.
  std::optional<double> rate;
  double off_s = 0;    ///< of the film's clock, at the end of the commands
  std::string reason;  ///< why it cannot be told
};

/// The film's clock is stretched, from half to twice as fast, and shifted as latencies may be,
/// until the robots' turns and ways agree best with the commands of their treads. It is reported
/// when the best stretch is far likelier than one that is a hundredth more or less, or, of a film
/// that is far off, than one half way to a right one. The run's start, `start_s` on the film's
/// clock, was read there, or on a clock that was right: then a film that is stretched has stretched
/// it, too.
FilmRate film_rate(std::span<const ToldAndSeen> robots, double start_s = 0);

}  // namespace swarmsmith
