#pragma once

#include <string>

#include "tracking/motion/internal/clock_checks.h"

namespace swarmsmith {

struct ClockStep {
  double at_s = 0;       ///< time of the run
  double lost_s = 0;     ///< time that the camera's clock lost; negative: it jumped ahead
  double between_s = 0;  ///< between the two pictures, by the camera's clock

  double driving_s() const { return between_s + lost_s; }
};

struct ClockSteps {
  int count = 0;
  ClockStep worst;
  double most_off_s = 0;      ///< largest error of the clock, by one step or the sum so far
  int backwards = 0;          ///< number of places where robots go back in time
  double backwards_at_s = 0;  ///< time of the first one, in the run
  std::string reason;         ///< why no result is possible
};

/// Finds steps of the clock: robots that move steadily show how much time passed between two
/// consecutive true pictures. There is a step where at least two robots agree that the time differs
/// from the clock by half an interval or more. If more time is lost, robots turn meanwhile; then
/// there is a step where at least two robots are suddenly farther away than a robot can drive,
/// while no robot goes on undisturbed. If the clock jumps ahead while they turn, there is a step
/// where all robots that move before and after are nearly at the same place.
ClockSteps clock_steps(const FilmedCamera& film);

}  // namespace swarmsmith
