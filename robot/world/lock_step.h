#pragma once

#include <cstdint>
#include <functional>

#include "base/expected.h"
#include "robot/transport/ends.h"
#include "sim/engine/profile.h"
#include "sim/engine/simulate.h"
#include "sim/mission/mission.h"

namespace swarmsmith {

/// One run of a simulated world, as in SimulationSetup; control software is on the other side.
struct WorldRun {
  const Profile& profile;
  const Mission& mission;
  const Instance& instance;
  std::int64_t seed = 1;

  /// For simulate() with a decider; the controller counts for nothing.
  SimulationSetup setup() const;
  /// BadInput when the mission has another number of robots.
  Expected<void> check(const WorldEnd& end) const;
};

struct WorldOptions {
  /// Until a robot's answer; then the run ends. The last command is never used again.
  Duration patience = std::chrono::seconds(5);
  /// Called with what a person should know while it runs.
  std::function<void(const std::string&)> tell = [](const std::string&) {};
  /// Whether the world is to end.
  std::function<bool()> is_over = [] { return false; };
};

/// Waits until every robot's node listens. Unavailable, with the names of those that are missing,
/// when `most` is over; what is missing is reported every few seconds.
Expected<void> wait_for_robots(WorldEnd& end, Duration most, const WorldOptions& options);

/// Runs the mission with the robots' nodes in lock-step: each control cycle's readings travel, and
/// the world stands still until all answers are there, so that the result has the bits of
/// simulate() with the nodes' controllers.
///
/// By number (SensorTopics::senses): a robot's answer names seed and cycle. By counting, on the
/// drivers' topics: the k-th message of each sensor is cycle k, and so is the k-th command, which
/// has the controller's state with it. Nothing may be lost there (Keep::All), and readings and
/// commands are rounded as the messages are.
///
/// Unavailable: a robot did not answer; the error names it and the cycle. BadInput: an answer to
/// another question.
Expected<SimulationResult> run_in_lock_step(WorldEnd& end, const SensorTopics& sensors,
                                            const WorldRun& run, const WorldOptions& options,
                                            const Recorder& recorder = {});

/// Tells the nodes that no more runs come (lock-step by number), and waits a second at most until
/// they have heard it.
void end_runs(WorldEnd& end);

}  // namespace swarmsmith
