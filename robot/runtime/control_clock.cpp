#include "robot/runtime/control_clock.h"

#include <algorithm>

namespace swarmsmith {

ControlClock::Beat ControlClock::beat(TimePoint now) {
  if (now < next() || last_ >= cycles_) return {};
  const std::int64_t cycle = std::min<std::int64_t>((now - start_) / period_, cycles_);
  const Beat beat{
      .cycle = cycle, .late = now - (start_ + cycle * period_), .skipped = cycle - last_ - 1};
  last_ = cycle;
  return beat;
}

}  // namespace swarmsmith
