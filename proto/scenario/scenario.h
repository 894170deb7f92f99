#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "programs/target.h"
#include "sim/control/flavour.h"
#include "sim/engine/profile.h"
#include "sim/mission/mission.h"

namespace swarmsmith {

/// The part of a method that a worker must know: the constants of its machines.
struct WorkerMethod {
  std::string flavour;  ///< name of the flavour
  TurnClock turn_clock = TurnClock::Cycles;
  const Flavour* own_flavour = nullptr;  ///< null: built in

  friend bool operator==(const WorkerMethod&, const WorkerMethod&) = default;
};

/// The part of a campaign that a worker must know in addition to a task.
struct WorkerScenario {
  std::string campaign_digest;
  int engine_version = 0;
  std::vector<Mission> missions;      ///< Task::mission is an index
  std::vector<WorkerMethod> methods;  ///< Task::method is an index
  Profile profile;
  std::vector<Profile>
      test_profiles;  ///< further ones: Task::profile n is the n-th of them, from 1
  /// Programs that evaluate instead of the simulator; missions, methods and profile are then empty.
  std::optional<Target> target;
  std::vector<InstanceTexts> instances;  ///< with a target: Task::mission is an index

  friend bool operator==(const WorkerScenario&, const WorkerScenario&) = default;
};

/// All campaigns that share the coordinator's workers; Task::campaign is an index.
using PoolScenario = std::vector<WorkerScenario>;

/// The scenarios as bytes for a message. Equal scenarios give equal bytes.
std::string to_bytes(const PoolScenario& scenarios);

/// Errors, with the field in `where`: bytes that are not scenarios, or contain none or too many.
/// For a simulation: all errors of campaign files, with line and column, and texts that name a
/// file. For programs: paths that are not absolute, numbers outside their limits, texts that cannot
/// be in a command line.
Expected<PoolScenario> scenarios_from_bytes(std::string_view bytes);

}  // namespace swarmsmith
