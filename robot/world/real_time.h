#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "robot/transport/ends.h"
#include "robot/world/faults.h"
#include "robot/world/lock_step.h"

namespace swarmsmith {

struct RealTimeOptions : WorldOptions {
  std::vector<Fault> faults;
  /// The start of the nodes' run, from the state of a node (as ordered by the operator); it becomes
  /// the world's instant 0. Without this function the world begins immediately.
  std::function<std::optional<TimePoint>(const StateMessage&)> start_of;
};

/// The result of a world in real time.
struct RealTimeResult {
  Measured simulation;
  TimePoint start;           ///< instant 0
  Duration latest{};         ///< the largest delay of the world behind its clock
  int stops_by_silence = 0;  ///< how often a robot's driver stopped it because commands stopped
  int stops_by_rivals = 0;   ///< how often it stopped it because two nodes sent commands
};

/// Runs the mission by the wall clock, as in a laboratory. Sensor readings are sent at the times of
/// the robots' clocks (of the profile), and a command acts from the step of 10 ms in which it
/// arrives, plus the profile's delays. Each robot has a SimulatedDriver. Before the start the
/// robots stand at their start poses, and their sensors work. Not reproducible.
Expected<RealTimeResult> run_in_real_time(WorldEnd& end, const SensorTopics& sensors,
                                          const WorldRun& run, const RealTimeOptions& options,
                                          const Recorder& recorder = {});

}  // namespace swarmsmith
