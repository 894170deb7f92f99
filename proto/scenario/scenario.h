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

/// What a worker must know of a method: which constants its machines run with.
struct WorkerMethod {
  std::string flavour;  ///< name
  TurnClock turn_clock = TurnClock::Cycles;
  const Flavour* own_flavour = nullptr;  ///< null: built in

  friend bool operator==(const WorkerMethod&, const WorkerMethod&) = default;
};

/// What a worker must know of a campaign besides a task.
struct WorkerScenario {
  std::string campaign_digest;
  int engine_version = 0;
  std::vector<Mission> missions;      ///< Task::mission is an index
  std::vector<WorkerMethod> methods;  ///< Task::method is an index
  Profile profile;
  std::vector<Profile> test_profiles;  ///< further ones: Task::profile counts them from 1
  /// Programs that evaluate in place of the simulator; missions, methods and profile are then
  /// empty.
  std::optional<Target> target;
  std::vector<InstanceTexts> instances;  ///< with a target: Task::mission is an index

  friend bool operator==(const WorkerScenario&, const WorkerScenario&) = default;
};

/// All campaigns that share the coordinator's workers; Task::campaign is an index.
using PoolScenario = std::vector<WorkerScenario>;

/// The scenarios as they travel. Equal ones give equal bytes.
std::string to_bytes(const PoolScenario& scenarios);

/// Errors, with the field in `where`: bytes that are not scenarios (or of none, or too many); of a
/// simulation what a campaign file would be refused for, with line and column, and a text that
/// names a file; of programs paths that are not absolute, numbers out of their limits, texts that
/// no command line may have.
Expected<PoolScenario> scenarios_from_bytes(std::string_view bytes);

}  // namespace swarmsmith
