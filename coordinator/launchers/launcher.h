#pragma once

#include <cstdint>
#include <string>

#include "base/clock.h"

namespace swarmsmith {

/// The state of a launcher's workers, for people. A worker here means a process of this host, one
/// behind a connected ssh, or one job of a batch system.
struct LauncherStatus {
  std::string name;  ///< "local", "ssh" or "slurm"
  std::int64_t wanted = 0;
  std::int64_t running = 0;
  std::int64_t pending = 0;  ///< waiting in a queue, or for a restart after a pause
  std::string waits_for{};   ///< the queue's reason for the wait, such as "Resources"
  std::string note{};        ///< a sentence about a problem, for people; empty if all is well

  friend bool operator==(const LauncherStatus&, const LauncherStatus&) = default;
};

/// "slurm: 2 of 4 workers run, 2 wait; NOTE".
std::string to_text(const LauncherStatus& status);

/// Starts workers somewhere and keeps them running. Each kind has a function `start`, which
/// requests the workers and returns the object. All calls must come from the thread that created
/// it, and only `stop` may block.
class Launcher {
 public:
  virtual ~Launcher() = default;

  /// Looks after the workers; called several times a second. If the workers can never be started,
  /// returns the reason; for temporary problems it sets a note in the status and tries again.
  virtual std::string tend(TimePoint now) = 0;
  /// Asks the workers to drain, waits about `grace` at most, and kills the rest. Returns a message
  /// about anything that a person must end by hand, or an empty text.
  virtual std::string stop(Duration grace) = 0;
  virtual LauncherStatus status() const = 0;

 protected:
  Launcher() = default;
  Launcher(Launcher&&) = default;
};

}  // namespace swarmsmith
