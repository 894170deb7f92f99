#pragma once

#include <algorithm>
#include <cstdint>

#include "base/rng.h"
#include "sim/engine/internal/beats.h"
#include "sim/engine/profile.h"

namespace swarmsmith {

/// When a robot acts: its control cycles, and how late its commands are (thesis 7.1). Time counts
/// in sub-steps of 10 ms since the start.
class RobotClock {
 public:
  /// `run` is the stream of the evaluation; `timing` must outlive the object.
  RobotClock(const ControlTiming& timing, const Rng& run, int robot);

  /// Its next control cycle, at a whole sub-step; what rounding takes from one period it gives to
  /// the next. Cycles shorter than a sub-step share one.
  std::int64_t next() const { return next_; }

  /// The present cycle is over.
  void next_cycle() {
    const double jitter =
        timing_->jitter == 0 ? 0 : jitter_.uniform(-timing_->jitter, timing_->jitter);
    due_ += period_ * (1 + jitter);
    const auto nearest =
        static_cast<std::int64_t>(due_ + 0.5);  // NOLINT(bugprone-incorrect-roundings)
    next_ = std::max(next_ + least_step_, nearest);
  }

  /// When the command that is computed at `now` begins to act: from the driver's next beat on, if
  /// it has any; after a delay that is drawn for it; but never before the command ahead of it.
  std::int64_t arrival_of_command(std::int64_t now) { return is_prompt_ ? now : draw_arrival(now); }

 private:
  std::int64_t draw_arrival(std::int64_t now);
  int draw_delay();

  const ControlTiming* timing_;
  bool is_prompt_;  ///< commands act at once
  Rng jitter_;
  Rng latency_;
  Beats driver_;
  double period_;            ///< of this robot in this run, sub-steps
  std::int64_t least_step_;  ///< from a cycle to the next: 0 when several may share a sub-step
  double due_ = 0;           ///< the next cycle, not rounded
  std::int64_t next_ = 0;
  std::int64_t last_arrival_ = 0;
};

}  // namespace swarmsmith
