#include "robot/runtime/control_clock.h"

#include <algorithm>

#include "base/assert.h"

namespace swarmsmith {

ControlClock::ControlClock(TimePoint start, Duration period, std::int64_t cycles)
    : start_(start), period_(period), cycles_(cycles) {
  SWARMSMITH_ASSERT(period_ > Duration::zero() && cycles_ >= 0, "time goes on from cycle to cycle");
}

ControlClock::Beat ControlClock::beat(TimePoint now) {
  if (now < next() || last_ >= cycles_) return {};
  const std::int64_t cycle = std::min<std::int64_t>((now - start_) / period_, cycles_);
  SWARMSMITH_ASSERT(cycle > last_, "each cycle is given once");
  const Beat beat{
      .cycle = cycle, .late = now - (start_ + cycle * period_), .skipped = cycle - last_ - 1};
  SWARMSMITH_ASSERT(beat.skipped >= 0 && beat.late >= Duration::zero(), "no cycle comes early");
  last_ = cycle;
  return beat;
}

}  // namespace swarmsmith
