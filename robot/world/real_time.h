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
  /// When the nodes' run begins, as a node's state tells it (what the operator ordered); the
  /// world's instant 0 is then. Without, the world begins at once.
  std::function<std::optional<TimePoint>(const StateMessage&)> start_of;
};

/// What a world in real time saw.
struct RealTimeResult {
  SimulationResult simulation;
  TimePoint start;           ///< instant 0
  Duration latest{};         ///< the world was so far behind its clock at worst
  int stops_by_silence = 0;  ///< a robot's driver stopped it because no commands came
  int stops_by_rivals = 0;   ///< or because two nodes commanded it
};

/// Runs the mission by the wall clock, as a laboratory would: sensors are sent when the robots'
/// clocks (of the profile) say so, and a command acts from the step of 10 ms on in which it comes,
/// plus the profile's delays. Each robot has a SimulatedDriver. Before the start the robots stand
/// in their starting places, and their sensors work. Not reproducible.
Expected<RealTimeResult> run_in_real_time(WorldEnd& end, const SensorTopics& sensors,
                                          const WorldRun& run, const RealTimeOptions& options,
                                          const Recorder& recorder = {});

}  // namespace swarmsmith
