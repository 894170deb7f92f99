#pragma once

#include <string>

#include "tracking/motion/internal/clock_checks.h"

namespace swarmsmith {

struct ClockStep {
  double at_s = 0;    ///< of the run
  double lost_s = 0;  ///< by the camera's clock; negative: it jumped ahead
};

struct ClockSteps {
  int count = 0;
  ClockStep worst;
  double most_off_s = 0;  ///< of the sums of steps so far, the largest; or of one step
  std::string reason;     ///< why nothing can be told
};

/// Between each two true pictures of the run the robots that move steadily say how long it took. A
/// step is where at least two agree that it was half an interval more or less than the clock says.
ClockSteps clock_steps(const FilmedCamera& film);

}  // namespace swarmsmith
