#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "proto/socket.h"
#include "worker/pool.h"
#include "worker/protocol.h"

namespace swarmsmith {

/// Where a coordinator is, and the keys to talk to it; none: in plaintext.
struct CoordinatorAddress {
  std::string endpoint;  ///< tcp://host:port
  std::optional<ClientKeys> keys;
  std::vector<std::string> others{};  ///< endpoints where it may be found, too
};

struct WorkerServiceOptions {
  std::string endpoint;  ///< of the coordinator: tcp://host:port
  std::optional<ClientKeys> keys{};
  /// Asked before each try to connect, if it is there: a coordinator may move, and keys may change.
  /// An error is a try that failed.
  std::function<Expected<CoordinatorAddress>()> find{};
  /// Told when the coordinator has welcomed this worker, and when it is lost.
  std::function<void(bool connected)> on_connected{};
  WorkerOptions protocol;
  SocketOptions socket;
};

/// How it ended, and why in a sentence.
struct WorkerEnd {
  WorkerExit code = WorkerExit::Done;
  std::string reason;
};

/// A worker's loop: protocol, socket, clock and slots put together. Returns when the protocol says
/// so. `drain` asks for it (SIGTERM); `wakeup` wakes the loop, and may be notified from a signal
/// handler. Throws std::runtime_error when the operating system refuses something.
///
/// Items that still run when it ends are waited for, unless the process exits at once.
WorkerEnd serve(const WorkerServiceOptions& options, const WorkerIdentity& identity, Pool& pool,
                Wakeup& wakeup, const std::atomic<bool>& drain);

}  // namespace swarmsmith
