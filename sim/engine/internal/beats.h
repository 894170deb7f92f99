#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

#include "base/rng.h"

namespace swarmsmith {

/// The sub-steps at which a device of a robot does something of its own accord: regular ones, from
/// a first one that is drawn for robot and run, since devices are not all switched on at once.
class Beats {
 public:
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

  /// Every `interval` sub-steps; never, when it is 0. `run` is the stream of the evaluation; two
  /// devices of one name beat together.
  Beats(int interval, const Rng& run, std::string_view name, int robot)
      : interval_(interval),
        first_(interval == 0
                   ? kNever
                   : run.split(name, static_cast<std::uint64_t>(robot)).uniform_int(1, interval)) {}

  /// The first one behind `now`.
  std::int64_t after(std::int64_t now) const {
    if (now < first_) return first_;
    return first_ + ((now - first_) / interval_ + 1) * interval_;
  }

 private:
  std::int64_t interval_;
  std::int64_t first_;
};

/// Of the robot's driver (ControlTiming::driver_sub_steps).
inline Beats driver_beats(int interval, const Rng& run, int robot) {
  return Beats(interval, run, "driver", robot);
}

}  // namespace swarmsmith
