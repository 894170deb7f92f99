#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>

#include "sim/control/control_software.h"
#include "sim/control/controller.h"
#include "sim/control/flavour.h"
#include "sim/engine/decider.h"
#include "sim/engine/profile.h"
#include "sim/engine/readings.h"
#include "sim/mission/mission.h"

namespace swarmsmith {

/// Everything one evaluation is a function of. The controller must fit the flavour (parsing sees to
/// it); the referenced values must outlive the call.
struct SimulationSetup {
  const Controller& controller;
  const Flavour& flavour;
  const Profile& profile;
  const Mission& mission;
  const Instance& instance;
  std::int64_t seed = 1;  ///< of noise and control draws
};

/// What one evaluation gives.
struct SimulationResult {
  double score = 0;                ///< larger is better
  std::uint64_t state_digest = 0;  ///< of final poses, velocities and states: equal bits, equal run
};

/// The state of one robot at a global instant, for recorders and tests.
struct RobotRecord {
  Pose pose;
  Command command;  ///< computed in its last control cycle; without latency it acts in the next
  int state = 0;    ///< ControlSoftware::state, after that cycle
  /// What the recorder asked for, as read in that cycle; null in cycle 0, or when it asked for
  /// nothing.
  const Readings* readings = nullptr;
};

/// Everything that moves, at a global instant.
struct Snapshot {
  int cycle = 0;  ///< instants of 0.1 s since the start, which is 0
  std::span<const RobotRecord> robots;
  std::span<const Pose> objects;  ///< the arena's movable objects, in its order
};

/// Is called with the start, and then with each global instant.
struct Recorder {
  Recorder() = default;
  template <std::invocable<const Snapshot&> Observer>
  Recorder(Observer observer, Sensors wanted = {})  // NOLINT: any observer is a recorder
      : observe(std::move(observer)), sensors(wanted) {}

  std::function<void(const Snapshot&)> observe;
  Sensors sensors;  ///< what shall be read besides what the machine asks for
};

/// Runs the mission once. Pure: the same setup gives the same bits, on every machine, thread and
/// build; nothing is kept between calls. Without a recorder nothing is recorded and no sensor is
/// computed that no module asks for. Throws std::runtime_error when a pose or velocity is not
/// finite any more, which is a defect of the engine.
///
/// With a decider, it decides in place of `setup.controller`, which then counts for nothing, and
/// the result is as pure as its answers. Throws std::invalid_argument when an answer's speeds are
/// not finite.
SimulationResult simulate(const SimulationSetup& setup, const Recorder& recorder = {},
                          Decider* decider = nullptr);

/// Part of the digest of a campaign: raised with every change that changes a score's bits.
inline constexpr int kEngineVersion = 3;
/// The version of missions in which the exact contact model meets fixed obstacles. They were played
/// by Box2D in version 3; all others have its bits.
inline constexpr int kObstaclesVersion = 4;
/// The version of missions where something as high as the robots' camera can hide them from each
/// other: before, they saw through all. The next version of all is 6.
inline constexpr int kSightVersion = 5;

/// The version that gives the mission's scores under this profile.
int engine_version_of(const Mission& mission, const Profile& profile);

}  // namespace swarmsmith
