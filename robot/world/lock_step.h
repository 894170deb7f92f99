#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "base/expected.h"
#include "robot/transport/ends.h"
#include "sim/engine/profile.h"
#include "sim/engine/simulate.h"
#include "sim/mission/mission.h"

namespace swarmsmith {

/// One run of a simulated world, as in SimulationSetup; control software runs in the nodes.
struct WorldRun {
  const Profile& profile;
  const Mission& mission;
  const Instance& instance;
  std::int64_t seed = 1;

  /// For simulate() with a decider; the controller in it is ignored.
  SimulationSetup setup() const;
  /// BadInput when the number of robots in the mission is different.
  Expected<void> check(const WorldEnd& end) const;
};

struct WorldOptions {
  /// How long to wait for a robot's answer; then the run ends. The last command is never reused.
  Duration patience = std::chrono::seconds(5);
  /// Called with remarks for the user during a run.
  std::function<void(const std::string&)> tell = [](const std::string&) {};
  /// Called with the first state of each robot's node, before a run: the reason why it cannot take
  /// part. Without it, the world does not wait for states.
  std::function<std::optional<std::string>(const StateMessage&)> objection;
  /// Whether the world must end.
  std::function<bool()> is_over = [] { return false; };
};

/// Waits until every robot's node is connected, and has sent its state. BadInput: there is an
/// objection to it. Unavailable, with the names of the missing robots,
/// after `most`; missing robots are also reported every few seconds.
Expected<void> wait_for_robots(WorldEnd& end, Duration most, const WorldOptions& options);

/// Runs the mission with the robots' nodes in lock-step: the readings of each control cycle are
/// sent, and the world waits until all answers have arrived, so the result has the same bits as
/// simulate() with the nodes' controllers.
///
/// In numbered lock-step (SensorTopics::senses), a robot's answer contains seed and cycle. In
/// counted lock-step, on the drivers' topics, the k-th message of each sensor belongs to cycle k,
/// and so does the k-th command, which also contains the controller's state. No message may be lost
/// there (Keep::All), and readings and commands are rounded to the precision of the messages.
///
/// Unavailable: a robot did not answer; the error gives its name and the cycle. BadInput: the
/// answer belongs to another question.
Expected<Measured> run_in_lock_step(WorldEnd& end, const SensorTopics& sensors, const WorldRun& run,
                                    const WorldOptions& options, const Recorder& recorder = {});

/// Tells the nodes that there are no more runs (numbered lock-step), and waits for at most a second
/// until they have received it.
void end_runs(WorldEnd& end);

}  // namespace swarmsmith
