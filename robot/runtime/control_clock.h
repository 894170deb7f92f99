#pragma once

#include <cstdint>

#include "base/clock.h"

namespace swarmsmith {

/// The deadlines of a run's control cycles: cycle k, counted from 1, is due at start + k periods. A
/// cycle that is a whole period late is not made up for: it is skipped and counted.
class ControlClock {
 public:
  ControlClock(TimePoint start, Duration period, std::int64_t cycles);

  struct Beat {
    std::int64_t cycle = 0;  ///< 0: no cycle is due
    Duration late{};
    std::int64_t skipped = 0;  ///< number of skipped cycles before it
  };

  /// The cycle that is due at `now`; each is returned once. After the last one none is returned.
  Beat beat(TimePoint now);

  TimePoint start() const { return start_; }
  /// The time when the next cycle is due.
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
