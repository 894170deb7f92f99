#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "sim/engine/simulate.h"
#include "sim/mission/mission.h"
#include "sim/mission/trajectory.h"

namespace swarmsmith::film {

/// A run of the simulator, as the truth of a film.
struct RecordedRun {
  Mission mission;
  Instance instance;
  Trajectory trajectory;  ///< of the mission's cycles
  double score = 0;
  /// A robot's poses from the start on, some cycles beyond the mission's end, since real robots do
  /// not freeze there.
  std::vector<std::vector<Pose>> poses;
  double step_s = 0.1;  ///< from one of those to the next
  /// What ran; empty for a run that another laboratory recorded.
  std::string machine;
  std::string flavour;
  std::optional<double> latency_s;  ///< from command to treads; none when it varies
  /// A robot's commands and states, decided at cycle 1, 2, ...; none of a recorded run.
  std::vector<std::vector<RobotRecord>> decided;
  /// The neighbours that they saw in those cycles.
  std::vector<std::vector<std::vector<Neighbour>>> neighbours;
};

struct RunWish {
  std::string mission = "aggregation";
  std::string machine;  ///< a text of the grammar, or "tA3": a design of the thesis' data
  std::string flavour = "watermelon-argos3";
  std::string profile = "rvr";
  std::int64_t seed = 1;
  std::optional<double> seconds;  ///< instead of the mission's duration
  /// From each command to the treads, at a steady control period; 0: timing as the profile has it.
  double latency_s = 0;
  /// Poses of each step of the simulator, 10 ms: the film has its motion between control cycles,
  /// too. The run is not the one that the seed gives without it.
  bool every_step = false;
  /// A trajectory that another laboratory recorded, as CSV, in place of machine and profile; the
  /// seed is that of its patches.
  std::string trajectory;
};

/// `designs` is the CSV of the thesis' machines (tests/golden/argos/argos-thesis-designs.csv).
Expected<RecordedRun> record_run(const RunWish& wish, const std::string& designs);

/// How far a robot's last pose is, at least, from one that would change the score by being there:
/// the truth's own distance to a border, found by trying, on rings of half a millimetre. `most_m`
/// when there is none so near.
double distance_to_change(const RecordedRun& run, std::size_t robot, double most_m = 0.05);

}  // namespace swarmsmith::film
