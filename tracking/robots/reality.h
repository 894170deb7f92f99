#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/mission/mission.h"
#include "tracking/observing/neighbours_seen.h"
#include "tracking/observing/observations.h"
#include "tracking/robots/latency.h"
#include "tracking/robots/slip.h"

namespace swarmsmith {

/// The behaviour of one robot in a real run, as far as a simulator's profile can use it.
struct Reality {
  Latency latency;
  Slip slip;
  std::vector<double> delays_s;  ///< delays of single commands, from delays_of; empty if unknown
  NeighboursSeen neighbours;
  std::optional<double> period_s;                ///< of its control cycles; none for fewer than 50
  std::vector<std::pair<int, double>> states_s;  ///< time in each state of its machine
};

/// A robot in a run.
struct RobotOfRun {
  const TrackedRun& run;
  const Mission& mission;
  std::size_t robot = 0;  ///< its index in the run
  const RobotLog& log;
};

/// Determines the behaviour of a robot; `latency` is the result of judge_robots. Pure.
Reality reality_of(const RobotOfRun& of, const Latency& latency);

/// Compares the log's readings with the camera's poses at the time of the readings. A neighbour
/// counts as present if it is well within the range of neighbours, and as seen if the log has a
/// neighbour in its direction and at its distance. A stored log without readings gives the result
/// that was stored with it.
NeighboursSeen neighbours_of(const RobotOfRun& of);

/// The time on the robot's clock at the start of the run.
double begin_of(const RunRecord& record);
/// The tread speeds in the log, by the time of the run.
std::vector<TimedCommand> commands_of(const RunRecord& record);

}  // namespace swarmsmith
