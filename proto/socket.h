#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "base/expected.h"
#include "proto/role.h"
#include "proto/wakeup.h"

namespace swarmsmith {

/// A connection of a ServerSocket, named by the socket itself (peers cannot choose their names). A
/// peer that connects again gets another one.
using PeerId = std::uint32_t;

enum class SendStatus {
  Sent,
  Gone,  ///< no such connection any more
  Full,  ///< the peer reads too slowly
};

/// What a socket does with connections; shortened in tests.
struct SocketOptions {
  std::chrono::milliseconds heartbeat_interval{1000};
  /// A connection without any sign of life for this long is closed.
  std::chrono::milliseconds heartbeat_timeout{3000};
  std::chrono::milliseconds handshake_timeout{3000};
  std::chrono::milliseconds linger{0};
  int send_queue = 1000;  ///< messages a peer
};

/// The coordinator's end: one socket, a connection a worker, one frame a message. One thread. What
/// the operating system refuses is an exception (std::runtime_error).
class ServerSocket {
 public:
  struct Received {
    PeerId peer = 0;
    std::string_view frame;  ///< until the next call; empty when the message was no single frame
    Role role = Role::Anyone;
    std::string_view client;  ///< name of its key in the allow-list, as long; empty without keys
  };

  /// `endpoint` as "tcp://127.0.0.1:5555"; port * takes a free one. Unavailable when it is taken.
  static Expected<std::unique_ptr<ServerSocket>> bind(const std::string& endpoint,
                                                      const SocketOptions& options = {});
  ~ServerSocket();

  /// The real one, with its port.
  const std::string& endpoint() const;
  /// Never blocks.
  SendStatus send(PeerId peer, std::string_view frame);
  /// Takes a message if there is one; false if not. Over-long messages never arrive: their
  /// connection is closed.
  bool receive(Received& received);
  /// Until a message can be taken, `wakeup` is notified, or the time is over.
  void wait(const Wakeup& wakeup, std::chrono::milliseconds timeout);

 private:
  struct Impl;
  explicit ServerSocket(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// The worker's end. Never connects again by itself: `lost` tells, and `connect` starts anew. One
/// thread.
class ClientSocket {
 public:
  explicit ClientSocket(std::string endpoint, const SocketOptions& options = {});
  ~ClientSocket();

  /// Drops the old connection, if any, and what it had not sent, and begins a new one.
  void connect();
  /// Drops the connection; what was sent goes out within `linger`.
  void close(std::chrono::milliseconds linger);
  /// Never blocks; frames sent before the connection stands are queued. Gone when not connected.
  SendStatus send(std::string_view frame);
  /// Takes a frame if there is one; false if not.
  bool receive(std::string& frame);
  /// Whether the connection broke, or could not be made, since the last call.
  bool lost();
  void wait(const Wakeup& wakeup, std::chrono::milliseconds timeout);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether the text is tcp://HOST:PORT, with a number up to 65535 for the port, or * for a free
/// one.
bool is_tcp_address(std::string_view endpoint);

}  // namespace swarmsmith
