#include "sim/engine/internal/robot_clock.h"

#include <algorithm>

#include "sim/engine/internal/body.h"

namespace swarmsmith {

RobotClock::RobotClock(const ControlTiming& timing, const Rng& run, int robot)
    : timing_(&timing),
      jitter_(run.split("jitter", static_cast<std::uint64_t>(robot))),
      latency_(run.split("latency", static_cast<std::uint64_t>(robot))),
      period_(kSubStepsPerInstant * run.split("period", static_cast<std::uint64_t>(robot))
                                        .uniform(timing.least_period, timing.most_period)) {
  next_cycle();
}

std::int64_t RobotClock::draw_arrival(std::int64_t now) {
  double u = latency_.uniform();
  int delay = timing_->delays.back().sub_steps;
  for (const ControlTiming::Delay& choice : timing_->delays) {
    u -= choice.probability;
    if (u >= 0) continue;
    delay = choice.sub_steps;
    break;
  }
  last_arrival_ = std::max(last_arrival_, now + delay);
  return last_arrival_;
}

}  // namespace swarmsmith
