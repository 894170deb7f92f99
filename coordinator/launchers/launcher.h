#pragma once

#include <cstdint>
#include <string>

#include "base/clock.h"

namespace swarmsmith {

/// How a launcher's workers are, for people. A worker is here a process of this host, one behind
/// ssh that is connected, or one job of a batch system.
struct LauncherStatus {
  std::string name;  ///< "local", "ssh" or "slurm"
  std::int64_t wanted = 0;
  std::int64_t running = 0;
  std::int64_t pending = 0;  ///< in a queue, or started again after a pause
  std::string waits_for{};   ///< what the queue says why, such as "Resources"
  std::string note{};        ///< what a person should know, a sentence; empty when all is well

  friend bool operator==(const LauncherStatus&, const LauncherStatus&) = default;
};

/// "slurm: 2 of 4 workers run, 2 wait; NOTE".
std::string to_text(const LauncherStatus& status);

/// Starts workers somewhere and keeps them there. An object exists once its workers were asked for:
/// each kind has a function `start` that makes one. All calls come from the thread that made it,
/// and none but `stop` waits for anything.
class Launcher {
 public:
  virtual ~Launcher() = default;

  /// Looks after the workers; several times a second. Returns why workers can never be had, if so:
  /// what may pass by itself is a note of the status, and is tried again.
  virtual std::string tend(TimePoint now) = 0;
  /// Asks the workers to drain, waits at most about `grace`, and ends the others. Returns what a
  /// person has to end by hand, if anything.
  virtual std::string stop(Duration grace) = 0;
  virtual LauncherStatus status() const = 0;

 protected:
  Launcher() = default;
  Launcher(Launcher&&) = default;
};

}  // namespace swarmsmith
