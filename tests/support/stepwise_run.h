#pragma once

#include <cstdint>
#include <vector>

#include "sim/engine/simulate.h"

namespace swarmsmith {

/// A run as the simulator's own steps of 10 ms have it: what a camera with any frame rate sees.
struct StepwiseRun {
  static constexpr double kStep_s = 0.01;

  /// A robot's poses, the start first.
  std::vector<std::vector<Pose>> poses;
  /// A robot's commands and states of cycle 1, 2, ... at 0.1 s, 0.2 s, ...; without readings.
  std::vector<std::vector<RobotRecord>> decided;
  /// The neighbours that it saw in those cycles.
  std::vector<std::vector<std::vector<Neighbour>>> neighbours;
};

/// The control period is 0.1 s, whatever the profile says; delays, slip and noise are the
/// profile's. Commands take the direction of the heading at each step, as real treads do. Noise is
/// drawn anew, so it is not the run that the same seed gives without this.
StepwiseRun run_stepwise(const SimulationSetup& setup);

}  // namespace swarmsmith
