#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/address.h"
#include "base/expected.h"
#include "proto/curve.h"
#include "proto/role.h"
#include "proto/wakeup.h"

namespace swarmsmith {

/// A connection of a ServerSocket, with a number from the socket itself (peers cannot choose it). A
/// peer that connects again gets a new one.
using PeerId = std::uint32_t;

enum class SendStatus {
  Sent,
  Gone,   ///< the connection does not exist any more
  Full,   ///< the peer reads too slowly; a server has closed the connection
  Later,  ///< not sent: a long frame, while too many others are on their way
};

/// Limits and times for connections; tests use shorter ones.
struct SocketOptions {
  std::chrono::milliseconds heartbeat_interval{1000};
  /// A connection without any sign of life for this long is closed.
  std::chrono::milliseconds heartbeat_timeout{3000};
  std::chrono::milliseconds handshake_timeout{3000};
  std::chrono::milliseconds linger{0};
  int send_queue = 1000;  ///< messages for each peer
  /// On loopback without keys, a server sends an empty frame to each newcomer, which shows whether
  /// the connection that sent the first message is still the one whose user is known. This can be
  /// turned off for clients of other programs that do not expect the frame. Without it, two clients
  /// could be confused at the moment when the connection of one ends and that of the other begins.
  bool probes_newcomers = true;
  /// The server closes connections above these limits, including half-open ones (orchestration
  /// facts, 5 "Limits"); connections that do not complete the handshake are closed after
  /// `handshake_timeout`. Each connection needs a descriptor: if the process's limit is lower,
  /// libzmq leaves newcomers in the system's queue. ZMQ_MAX_SOCKETS is not a limit here, since one
  /// socket has all connections.
  int max_connections = 10'000;
  /// The limit for one address; all of loopback counts as one, and so does an IPv6 network of 64
  /// bits.
  int max_connections_of_host = 6'000;
  // Limits in bytes on received data that a server holds, for a connection, a host and in total.
  // Beyond them the connections with the most data are closed.
  std::size_t most_waiting = 8U << 20U;  ///< received and not yet taken
  std::size_t most_waiting_of_host = 32U << 20U;
  std::size_t most_waiting_of_all = 64U << 20U;
  std::size_t most_waiting_memory = 48U << 20U;  ///< growth of the process while much data waited
  // Limits on sent data that has not arrived yet. Beyond them long frames (scenarios) wait, and
  // peers that take short ones too slowly are disconnected.
  std::size_t most_unsent = 8U << 20U;  ///< in addition to one long frame
  std::size_t most_unsent_to_host = 40U << 20U;
  std::size_t most_unsent_to_all = 64U << 20U;
};

/// Counts of peers that were refused or disconnected since the start.
struct Refusals {
  /// By reason: "unlisted key", "expired key", "revoked key", "plaintext", "wrong server key", "bad
  /// handshake", "no handshake" (invalid data, silence, or a peer that closed the connection
  /// first), "another user", "too many connections", "too many connections of one host", "too much
  /// at once" (more bytes than the server can take), "reads too slowly".
  std::map<std::string, std::uint64_t> counts;
  std::map<std::string, std::string> last_from;  ///< address or name of the key, if known

  std::uint64_t total() const;
};

/// The coordinator's end: one socket with one connection for each worker; a message is one frame.
/// Not thread-safe. Errors of the operating system are thrown as std::runtime_error.
class ServerSocket {
 public:
  struct Received {
    PeerId peer = 0;
    std::string_view
        frame;  ///< valid until the next call; empty when the message was not a single frame
    Role role = Role::Anyone;
    std::string_view client;  ///< name of its key in the allow-list, valid as long as `frame`;
                              ///< empty without keys
    std::string_view
        address;  ///< of the peer, numeric and without a port, valid as long as `frame`
  };

  /// `endpoint` such as "tcp://127.0.0.1:5555"; port * takes a free one. Conflict when the port is
  /// in use, Unavailable when the address cannot be used. A name is looked up first. With keys,
  /// connections are encrypted, and only listed clients are admitted (orchestration facts, 6).
  /// Without keys all clients are admitted, as Role::Anyone; but on loopback only processes of this
  /// process's user and of root.
  static Expected<std::unique_ptr<ServerSocket>> bind(const std::string& endpoint,
                                                      const SocketOptions& options = {},
                                                      std::optional<ServerKeys> keys = {});
  ~ServerSocket();

  /// The actual endpoint, with its port.
  const std::string& endpoint() const;
  /// Whether other users of this host are refused: on loopback without keys, if the kernel tells
  /// the user of a connection.
  bool asks_for_user() const;
  /// Never blocks.
  SendStatus send(PeerId peer, std::string_view frame);
  /// Takes a message if there is one; false if not. Messages that are too long never arrive: their
  /// connection is closed.
  bool receive(Received& received);
  /// Waits until a message can be taken, `wakeup` is notified, or the time is over.
  void wait(const Wakeup& wakeup, std::chrono::milliseconds timeout);

  /// Sets a new list of clients. Connections whose key is no longer in the list, or has expired,
  /// are closed immediately, and nothing that they have sent is received. Returns those that have
  /// sent a message before.
  std::vector<PeerId> admit(std::vector<ListedClient> clients);
  Refusals refusals() const;

 private:
  struct Impl;
  explicit ServerSocket(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// The worker's end. It never reconnects automatically: `lost` reports that the connection ended,
/// and `connect` makes a new one. On loopback without keys it connects only to processes of its own
/// user or of root. Not thread-safe.
class ClientSocket {
 public:
  explicit ClientSocket(std::string endpoint, const SocketOptions& options = {},
                        std::optional<ClientKeys> keys = {});
  ~ClientSocket();

  /// Sets the endpoint and keys for the next `connect`. `others`: further endpoints of the same
  /// server.
  void redirect(std::string endpoint, std::optional<ClientKeys> keys,
                std::vector<std::string> others = {});
  /// Drops the old connection, if any, with its unsent frames, and begins a new one. It looks up
  /// the host's name, which may take seconds; each call tries the next one of the host's addresses.
  void connect();
  /// Drops the connection; frames that were sent before are still delivered within `linger`.
  void close(std::chrono::milliseconds linger);
  /// Never blocks; frames that are sent before the connection is established are queued. Gone when
  /// not connected.
  SendStatus send(std::string_view frame);
  /// Takes a frame if there is one; false if not. Empty frames are skipped.
  bool receive(std::string& frame);
  /// Whether the connection broke, or could not be made, since the last call.
  bool lost();
  /// The reason as a sentence, if it is known: an unknown name, a port of another user.
  const std::string& trouble() const;
  /// Number of addresses from which the last `connect` could choose; and whether it established a
  /// connection.
  std::size_t choices() const;
  bool stood() const;
  /// Whether the last connection ended because the server refuses this client's key.
  bool refused() const;
  void wait(const Wakeup& wakeup, std::chrono::milliseconds timeout);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

inline constexpr std::string_view kTcpScheme = "tcp://";
/// The address in tcp://HOST:PORT; empty for other texts.
std::optional<Address> address_of(std::string_view endpoint);
std::string tcp_endpoint(const Address& address);

}  // namespace swarmsmith
