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

/// What a run tells of the world as it is, of one robot: what a simulator's profile can be made of.
struct Reality {
  Latency latency;
  Slip slip;
  std::vector<double> delays_s;  ///< of single commands, delays_of; empty where none can be told
  NeighboursSeen neighbours;
  std::optional<double> period_s;                ///< of its control cycles; none of fewer than 50
  std::vector<std::pair<int, double>> states_s;  ///< time in each state of its machine, by state
};

/// A robot in a run.
struct RobotOfRun {
  const TrackedRun& run;
  const Mission& mission;
  std::size_t robot = 0;  ///< its number
  const RobotLog& log;
};

/// `latency` as judge_robots found it. Pure.
Reality reality_of(const RobotOfRun& of, const Latency& latency);

/// By the log's readings and the camera's poses at the time they were taken: a robot is there when
/// it is well within the range of neighbours, and seen when the log has one in its direction and at
/// its distance. What a stored log knows of them is taken where it has no readings.
NeighboursSeen neighbours_of(const RobotOfRun& of);

/// The clock of the robot at 0 s of the run.
double begin_of(const RunRecord& record);
/// Speeds of the treads as the log has them, by the time of the run.
std::vector<TimedCommand> commands_of(const RunRecord& record);

}  // namespace swarmsmith
