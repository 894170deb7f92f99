#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

#include "base/rng.h"

namespace swarmsmith {

/// The sub-steps at which a device of a robot acts on its own timer. They are regular; the first
/// one is drawn per robot and run, because devices are not all switched on at the same time.
class Beats {
 public:
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

  /// A beat every `interval` sub-steps, or never if it is 0. `run` is the stream of the evaluation;
  /// two devices of a robot with the same name and interval beat together.
  Beats(int interval, const Rng& run, std::string_view name, int robot)
      : interval_(interval),
        first_(interval == 0
                   ? kNever
                   : run.split(name, static_cast<std::uint64_t>(robot)).uniform_int(1, interval)) {}

  /// The first beat after `now`.
  std::int64_t after(std::int64_t now) const {
    if (now < first_) return first_;
    return first_ + ((now - first_) / interval_ + 1) * interval_;
  }

 private:
  std::int64_t interval_;
  std::int64_t first_;
};

/// The beats of the robot's driver (ControlTiming::driver_sub_steps).
inline Beats driver_beats(int interval, const Rng& run, int robot) {
  return Beats(interval, run, "driver", robot);
}

}  // namespace swarmsmith
