#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "sim/control/control_software.h"
#include "sim/control/flavour.h"
#include "sim/control/machine.h"
#include "sim/engine/profile.h"
#include "sim/mission/mission.h"

namespace swarmsmith {

/// Everything one evaluation is a function of. The machine must fit the flavour (parsing sees to
/// it); the referenced values must outlive the call.
struct SimulationSetup {
  const Machine& machine;
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
  Command command;  ///< computed in this cycle, acts in the next
  int state = 0;    ///< of the machine, after this cycle's transition test
};

/// Called after each control cycle (1, 2, ...) with one record a robot; also with cycle 0, the
/// start.
using Recorder = std::function<void(int cycle, std::span<const RobotRecord>)>;

/// Runs the mission once. Pure: the same setup gives the same bits, on every machine, thread and
/// build; nothing is kept between calls. Without a recorder nothing is recorded and no sensor is
/// computed that no module asks for.
SimulationResult simulate(const SimulationSetup& setup, const Recorder& recorder = {});

/// Part of the digest of a campaign: raised with every change that changes a score's bits.
inline constexpr int kEngineVersion = 1;

}  // namespace swarmsmith
