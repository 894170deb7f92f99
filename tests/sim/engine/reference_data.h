#pragma once

#include <array>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "sim/mission/mission.h"

namespace swarmsmith {

/// The original simulator's data in tests/golden/argos, as values. A missing or malformed file
/// throws: a test cannot go on without it.

/// One robot in one tick of a recorded run. Speeds in cm/s; proximity as recorded: inf beyond 0.4
/// m, -inf closer than 0.05 m, 0 for nothing within 2 m.
struct LoggedTick {
  Pose pose;
  double left_cmps = 0;
  double right_cmps = 0;
  Rgb floor;
  int neighbours = 0;
  std::array<double, kProximitySensors> proximity{};
};

/// [tick][robot]; tick 0 is the start and holds no readings.
using LoggedRun = std::vector<std::array<LoggedTick, 3>>;

/// `name` as in the file's name: "grid-hG5-seed1".
LoggedRun logged_run(const std::string& name);

/// The three recorded runs.
inline constexpr std::array<const char*, 3> kLoggedRuns = {"aggregation-hA6-seed1",
                                                           "color-hC1-seed1", "grid-hG5-seed1"};

/// Missions of the reference data: our name, and the files'.
struct ReferenceMission {
  const char* ours;
  const char* theirs;

  /// The name that tests show.
  friend void PrintTo(const ReferenceMission& mission, std::ostream* out) { *out << mission.ours; }
};
inline constexpr std::array<ReferenceMission, 3> kReferenceMissions = {
    ReferenceMission{"aggregation", "aggregation"}, ReferenceMission{"grid_exploration", "grid"},
    ReferenceMission{"color_selection", "color"}};

/// A machine of the reference data. `mission` (the files' name) is empty for the twenty machines
/// that ran on all three.
struct ReferenceMachine {
  std::string id;
  std::string mission;
  std::string text;
};

std::vector<ReferenceMachine> reference_machines();  ///< the twenty
std::vector<ReferenceMachine> thesis_designs();      ///< the thirty, each for its own mission

/// [mission][machine][seed] -> score, larger is better: the costs of grid exploration are negated.
using ReferenceScores = std::map<std::string, std::map<std::string, std::map<int, double>>>;
ReferenceScores reference_scores();  ///< of the twenty, seeds 1..100
ReferenceScores thesis_scores();     ///< of the thirty, seeds 1..30

/// The original's starting poses and colour patches of seeds 1..100: [0] is seed 1's.
std::vector<Instance> reference_instances(const Mission& mission);

}  // namespace swarmsmith
