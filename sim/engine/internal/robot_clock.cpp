#include "sim/engine/internal/robot_clock.h"

#include <algorithm>

#include "sim/engine/internal/body.h"

namespace swarmsmith {

RobotClock::RobotClock(const ControlTiming& timing, const Rng& run, int robot)
    : timing_(&timing),
      is_prompt_(timing.delays.empty() && timing.driver_sub_steps == 0),
      jitter_(run.split("jitter", static_cast<std::uint64_t>(robot))),
      latency_(run.split("latency", static_cast<std::uint64_t>(robot))),
      driver_(driver_beats(timing.driver_sub_steps, run, robot)),
      period_(kSubStepsPerInstant * run.split("period", static_cast<std::uint64_t>(robot))
                                        .uniform(timing.least_period, timing.most_period)),
      least_step_(period_ < 1 ? 0 : 1) {
  next_cycle();
  next_ = std::max<std::int64_t>(1, next_);  // sensors cannot be read before the start
}

std::int64_t RobotClock::draw_arrival(std::int64_t now) {
  const std::int64_t sent = timing_->driver_sub_steps == 0 ? now : driver_.after(now);
  // A command never overtakes the one before it: a late one also delays those after it.
  last_arrival_ = std::max(last_arrival_, sent + draw_delay());
  return last_arrival_;
}

int RobotClock::draw_delay() {
  if (timing_->delays.empty()) return 0;
  double u = latency_.uniform();
  for (const ControlTiming::Delay& choice : timing_->delays) {
    u -= choice.probability;
    if (u < 0) return choice.sub_steps;
  }
  // The probabilities sum to 1 only within 1e-9 (`is_distribution`).
  return timing_->delays.back().sub_steps;
}

}  // namespace swarmsmith
