#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/assessment/assessment.h"
#include "sim/control/machine.h"
#include "sim/engine/simulate.h"
#include "sim/mission/mission.h"

namespace swarmsmith::assessment {

/// Arenas and parameters of the assessment (thesis facts, section 10).

inline constexpr int kTau = 10;
inline constexpr double kAlpha = 3;
inline constexpr double kRho = 0.9;
inline constexpr double kMu = 2;
inline constexpr int kBehaviourRuns = 5;   ///< seeds 1, 2, ...
inline constexpr int kConditionRuns = 10;  ///< seeds 1, 2, ...
inline constexpr int kRobots = 3;
inline constexpr int kCycles = 1200;

/// Three robots for 120 s in this arena. Its score is not used.
Mission mission_in(Arena arena, const Robot& robot);

/// Starts anywhere in the arena, as in the missions.
std::vector<Pose> starts_anywhere(const Mission& mission, std::int64_t seed);

/// The distances between robots of a group: 0.5 to 0.7 m if a robot sees others up to 0.75 m or
/// farther; for a shorter range the same fractions of it.
struct PairDistances {
  double nearest_m = 0;
  double farthest_m = 0;
};
PairDistances pairs_of(const Robot& robot);

/// Starts around the centre, with all pairs at such distances and any heading.
std::vector<Pose> starts_in_a_group(const Robot& robot, std::int64_t seed);

/// One recorded run.
struct Trial {
  const Machine& machine;
  const Subject& subject;
  const Mission& mission;
};
void watch(const Trial& trial, std::vector<Pose> starts, std::int64_t seed,
           const Recorder& recorder);

/// The range of the values, as a short text: "0.31 to 0.42" with `digits` decimals.
std::string range_text(const std::vector<double>& values, int digits);

}  // namespace swarmsmith::assessment
