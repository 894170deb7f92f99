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

/// The address of a coordinator, and the keys for the connection; none: plaintext.
struct CoordinatorAddress {
  std::string endpoint;  ///< tcp://host:port
  std::optional<ClientKeys> keys;
  std::vector<std::string> others{};  ///< other endpoints where it may be
};

struct WorkerServiceOptions {
  std::string endpoint;  ///< the coordinator's endpoint: tcp://host:port
  std::optional<ClientKeys> keys{};
  /// If set, called before each attempt to connect: the coordinator may move, and keys may change.
  /// An error counts as a failed attempt.
  std::function<Expected<CoordinatorAddress>()> find{};
  /// Called when the coordinator has welcomed this worker, and when the connection is lost.
  std::function<void(bool connected)> on_connected{};
  WorkerOptions protocol;
  SocketOptions socket;
};

/// The exit code and the reason as a sentence.
struct WorkerEnd {
  WorkerExit code = WorkerExit::Done;
  std::string reason;
};

/// A worker's event loop, with protocol, socket, clock and slots. Returns when the protocol decides
/// to leave. `drain` requests draining (SIGTERM); `wakeup` wakes the loop, and may be notified from
/// a signal handler. Throws std::runtime_error if the operating system refuses a resource.
///
/// It waits for items that are still running at the end, unless the process exits at once.
WorkerEnd serve(const WorkerServiceOptions& options, const WorkerIdentity& identity, Pool& pool,
                Wakeup& wakeup, const std::atomic<bool>& drain);

}  // namespace swarmsmith
