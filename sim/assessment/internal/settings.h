#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/assessment/assessment.h"
#include "sim/control/machine.h"
#include "sim/engine/simulate.h"
#include "sim/mission/mission.h"

namespace swarmsmith::assessment {

/// Where and with what modules are assessed (thesis facts, section 10).

inline constexpr int kTau = 10;
inline constexpr double kAlpha = 3;
inline constexpr double kRho = 0.9;
inline constexpr double kMu = 2;
inline constexpr int kBehaviourRuns = 5;   ///< seeds 1, 2, ...
inline constexpr int kConditionRuns = 10;  ///< seeds 1, 2, ...
inline constexpr int kRobots = 3;
inline constexpr int kCycles = 1200;

/// Three robots for 120 s in this arena. Its score is of no interest.
Mission mission_in(Arena arena, const Robot& robot);

/// Starts anywhere in the arena, as the missions have them.
std::vector<Pose> starts_anywhere(const Mission& mission, std::int64_t seed);

/// How far the robots of a group are apart: 0.5 to 0.7 m where a robot sees others up to 0.75 m or
/// farther, and these shares of the range where it is shorter.
struct PairDistances {
  double nearest_m = 0;
  double farthest_m = 0;
};
PairDistances pairs_of(const Robot& robot);

/// Starts around the centre, all pairs that far apart, any heading.
std::vector<Pose> starts_in_a_group(const Robot& robot, std::int64_t seed);

/// One run under the eyes of a recorder.
struct Trial {
  const Machine& machine;
  const Subject& subject;
  const Mission& mission;
};
void watch(const Trial& trial, std::vector<Pose> starts, std::int64_t seed,
           const Recorder& recorder);

/// The range of the values, in as few words: "0.31 to 0.42" with `digits` decimals.
std::string range_text(const std::vector<double>& values, int digits);

}  // namespace swarmsmith::assessment
