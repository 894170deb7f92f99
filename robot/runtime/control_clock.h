#pragma once

#include <cstdint>

#include "base/clock.h"

namespace swarmsmith {

/// The deadlines of a run's control cycles: cycle k, from 1, is due at start + k periods. A cycle
/// that is a whole period late is not caught up: it is skipped and counted.
class ControlClock {
 public:
  ControlClock(TimePoint start, Duration period, std::int64_t cycles);

  struct Beat {
    std::int64_t cycle = 0;  ///< 0: none is due
    Duration late{};
    std::int64_t skipped = 0;  ///< cycles before it that never were
  };

  /// The cycle that is due at `now`; each is given once. After the last one none is.
  Beat beat(TimePoint now);

  TimePoint start() const { return start_; }
  /// When the next cycle is due.
  TimePoint next() const { return start_ + (last_ + 1) * period_; }
  std::int64_t last() const { return last_; }
  std::int64_t cycles() const { return cycles_; }

 private:
  TimePoint start_;
  Duration period_;
  std::int64_t cycles_;
  std::int64_t last_ = 0;
};

}  // namespace swarmsmith
