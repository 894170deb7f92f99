#pragma once

#include <algorithm>
#include <cstdint>

#include "base/rng.h"
#include "sim/engine/internal/beats.h"
#include "sim/engine/profile.h"

namespace swarmsmith {

/// The times at which a robot acts: its control cycles, and the delays of its commands (thesis
/// 7.1). Time is counted in sub-steps of 10 ms since the start.
class RobotClock {
 public:
  /// `run` is the stream of the evaluation; `timing` must outlive the object.
  RobotClock(const ControlTiming& timing, const Rng& run, int robot);

  /// Its next control cycle, at a whole sub-step; a rounding error in one period is made up for in
  /// the next. Several cycles shorter than a sub-step may share one.
  std::int64_t next() const { return next_; }

  /// Ends the present cycle.
  void next_cycle() {
    const double jitter =
        timing_->jitter == 0 ? 0 : jitter_.uniform(-timing_->jitter, timing_->jitter);
    due_ += period_ * (1 + jitter);
    const auto nearest =
        static_cast<std::int64_t>(due_ + 0.5);  // NOLINT(bugprone-incorrect-roundings)
    next_ = std::max(next_ + least_step_, nearest);
  }

  /// The time at which the command computed at `now` begins to act: at the driver's next beat, if
  /// the driver has beats, and after a delay drawn for this command; but never before the preceding
  /// command.
  std::int64_t arrival_of_command(std::int64_t now) { return is_prompt_ ? now : draw_arrival(now); }

 private:
  std::int64_t draw_arrival(std::int64_t now);
  int draw_delay();

  const ControlTiming* timing_;
  bool is_prompt_;  ///< commands act immediately
  Rng jitter_;
  Rng latency_;
  Beats driver_;
  double period_;            ///< of this robot in this run, in sub-steps
  std::int64_t least_step_;  ///< least time from a cycle to the next: 0 if several may share a
                             ///< sub-step
  double due_ = 0;           ///< time of the next cycle, not rounded
  std::int64_t next_ = 0;
  std::int64_t last_arrival_ = 0;
};

}  // namespace swarmsmith
