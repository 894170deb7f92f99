#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>

#include "base/measured.h"
#include "sim/control/control_software.h"
#include "sim/control/controller.h"
#include "sim/control/flavour.h"
#include "sim/engine/decider.h"
#include "sim/engine/profile.h"
#include "sim/engine/readings.h"
#include "sim/mission/mission.h"

namespace swarmsmith {

/// All inputs of one evaluation. The controller must fit the flavour (parsing ensures this); the
/// referenced values must outlive the call.
struct SimulationSetup {
  const Controller& controller;
  const Flavour& flavour;
  const Profile& profile;
  const Mission& mission;
  const Instance& instance;
  std::int64_t seed = 1;  ///< of noise and of the draws of control software
};

/// The state of one robot at a global instant, for recorders and tests.
struct RobotRecord {
  Pose pose;
  Command command;  ///< computed in its last control cycle; without latency it acts from that
                    ///< instant on
  int state = 0;    ///< ControlSoftware::state after that cycle
  /// The readings that the recorder requested, from that cycle; null in cycle 0, or when it
  /// requested none.
  const Readings* readings = nullptr;
};

/// All moving bodies at a global instant.
struct Snapshot {
  int cycle = 0;  ///< instants of 0.1 s since the start; 0 at the start
  std::span<const RobotRecord> robots;
  std::span<const Pose> objects;  ///< the arena's movable objects, in the order of the arena
};

/// Called at the start, and then at each global instant.
struct Recorder {
  Recorder() = default;
  template <std::invocable<const Snapshot&> Observer>
  Recorder(Observer observer, Sensors wanted = {})  // NOLINT: any observer is a recorder
      : observe(std::move(observer)), sensors(wanted) {}

  std::function<void(const Snapshot&)> observe;
  Sensors sensors;  ///< sensors to read in addition to those that the machine uses
};

/// Runs the mission once. It is pure: the same setup gives the same bits on every computer, thread
/// and build; nothing is kept between calls. Without a recorder nothing is recorded, and only
/// sensors that modules use are computed. Throws std::runtime_error when a pose or velocity becomes
/// infinite or NaN, which is a defect of the engine.
///
/// A decider replaces `setup.controller`, which is then ignored; the result depends also on the
/// decider's answers. Throws std::invalid_argument when the speeds of an answer are not finite.
Measured simulate(const SimulationSetup& setup, const Recorder& recorder = {},
                  Decider* decider = nullptr);

/// Part of the digest of a campaign: it is raised with every change of the engine that changes the
/// bits of a score.
inline constexpr int kEngineVersion = 3;
/// The version for missions in which the exact contact model handles fixed obstacles. Box2D
/// simulated them in version 3; all other missions have the bits of version 3.
inline constexpr int kObstaclesVersion = 4;
/// The version for missions in which a body as high as the robots' camera can hide them from each
/// other; before, they saw through everything.
inline constexpr int kSightVersion = 5;
/// The version for missions of robots with light sensors in other directions than their proximity
/// sensors; before, control software took them to be in the same directions.
inline constexpr int kLightVersion = 6;
/// The version for robots whose ground sensors vote, under profiles with `timing.driver`; before,
/// flavours with `any_channel` saw gray until the driver's first beat. The next version for all
/// missions is 8.
inline constexpr int kVoteVersion = 7;

/// The version that gives the scores of the mission under this profile.
int engine_version_of(const Mission& mission, const Profile& profile);

}  // namespace swarmsmith
