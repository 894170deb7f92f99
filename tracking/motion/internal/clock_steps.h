#pragma once

#include <string>

#include "tracking/motion/internal/clock_checks.h"

namespace swarmsmith {

struct ClockStep {
  double at_s = 0;       ///< of the run
  double lost_s = 0;     ///< by the camera's clock; negative: it jumped ahead
  double between_s = 0;  ///< from the picture before to this one, by that clock

  double driving_s() const { return between_s + lost_s; }
};

struct ClockSteps {
  int count = 0;
  ClockStep worst;
  double most_off_s = 0;      ///< of the sums of steps so far, the largest; or of one step
  int backwards = 0;          ///< places where robots go back in time
  double backwards_at_s = 0;  ///< the first, of the run
  std::string reason;         ///< why nothing can be told
};

/// Between each two true pictures of the run the robots that move steadily say how long it took. A
/// step is where at least two agree that it was half an interval more or less than the clock says.
/// Where more is lost, robots turn meanwhile: then it is where at least two are farther at once
/// than any robot drives, and none goes on as if nothing had been. Where the clock jumps ahead
/// while they turn, it is where all that move before and after are nearly where they were.
ClockSteps clock_steps(const FilmedCamera& film);

}  // namespace swarmsmith
