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

/// A connection of a ServerSocket, named by the socket itself (peers cannot choose their names). A
/// peer that connects again gets another one.
using PeerId = std::uint32_t;

enum class SendStatus {
  Sent,
  Gone,   ///< no such connection any more
  Full,   ///< the peer reads too slowly; a server has ended the connection
  Later,  ///< a long frame while too many are on their way: not sent
};

/// What a socket does with connections; shortened in tests.
struct SocketOptions {
  std::chrono::milliseconds heartbeat_interval{1000};
  /// A connection without any sign of life for this long is closed.
  std::chrono::milliseconds heartbeat_timeout{3000};
  std::chrono::milliseconds handshake_timeout{3000};
  std::chrono::milliseconds linger{0};
  int send_queue = 1000;  ///< messages a peer
  /// On loopback without keys a server sends an empty frame to each newcomer, which tells whether
  /// the connection that spoke is still the one whose user it knows. Clients of others, who would
  /// not expect it, may be spared that; they could be taken for each other in the moment in which
  /// one's connection ends and the next one's begins.
  bool probes_newcomers = true;
  /// A server closes connections beyond these, half-open ones included (orchestration facts, 5
  /// "Limits"); those without a handshake end by themselves after `handshake_timeout`. Each takes a
  /// descriptor: where the process's limit is lower, libzmq leaves newcomers in the system's queue.
  /// ZMQ_MAX_SOCKETS does not limit them, since one socket has them all.
  int max_connections = 10'000;
  /// Of these, of one address; all of loopback is one, and so is an IPv6 network of 64 bits.
  int max_connections_of_host = 6'000;
  // What a server holds of others, in bytes, of a connection, of a host and of all. Beyond that
  // those who have most are cut off.
  std::size_t most_waiting = 8U << 20U;  ///< that came and was not taken
  std::size_t most_waiting_of_host = 32U << 20U;
  std::size_t most_waiting_of_all = 64U << 20U;
  std::size_t most_waiting_memory = 48U << 20U;  ///< by which the process grew while much waited
  // And what was sent to others and has not arrived there. Beyond it long frames (scenarios) wait,
  // and who takes what is short too slowly is cut off.
  std::size_t most_unsent = 8U << 20U;  ///< and one long frame
  std::size_t most_unsent_to_host = 40U << 20U;
  std::size_t most_unsent_to_all = 64U << 20U;
};

/// Who was kept out since the start, or cut off.
struct Refusals {
  /// By reason: "unlisted key", "expired key", "revoked key", "plaintext", "wrong server key", "bad
  /// handshake", "no handshake" (rubbish, silence, or a peer that hung up first), "another user",
  /// "too many connections", "too many connections of one host", "too much at once" (bytes that
  /// no worker could take), "reads too slowly".
  std::map<std::string, std::uint64_t> counts;
  std::map<std::string, std::string> last_from;  ///< address or key's name, where it is known

  std::uint64_t total() const;
};

/// The coordinator's end: one socket, a connection a worker, one frame a message. One thread. What
/// the operating system refuses is an exception (std::runtime_error).
class ServerSocket {
 public:
  struct Received {
    PeerId peer = 0;
    std::string_view frame;  ///< until the next call; empty when it was not a single frame
    Role role = Role::Anyone;
    std::string_view client;   ///< name of its key in the allow-list, as long; empty without keys
    std::string_view address;  ///< of the peer, a number without a port, as long
  };

  /// `endpoint` as "tcp://127.0.0.1:5555"; port * takes a free one. Unavailable when it is taken.
  /// A name is looked up first. With keys, connections are encrypted, and only listed clients come
  /// in (orchestration facts, 6). Without, all come in, as Role::Anyone; but on loopback only
  /// processes of this one's user, and root's.
  static Expected<std::unique_ptr<ServerSocket>> bind(const std::string& endpoint,
                                                      const SocketOptions& options = {},
                                                      std::optional<ServerKeys> keys = {});
  ~ServerSocket();

  /// The real one, with its port.
  const std::string& endpoint() const;
  /// Whether other users of this host are kept out: on loopback without keys, where the kernel says
  /// whose a connection is.
  bool asks_for_user() const;
  /// Never blocks.
  SendStatus send(PeerId peer, std::string_view frame);
  /// Takes a message if there is one; false if not. Over-long messages never arrive: their
  /// connection is closed.
  bool receive(Received& received);
  /// Until a message can be taken, `wakeup` is notified, or the time is over.
  void wait(const Wakeup& wakeup, std::chrono::milliseconds timeout);

  /// A new list of clients. Connections whose key is not in it any more, or has expired, are closed
  /// now and nothing that they sent is received; those of them that have spoken are returned.
  std::vector<PeerId> admit(std::vector<ListedClient> clients);
  Refusals refusals() const;

 private:
  struct Impl;
  explicit ServerSocket(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// The worker's end. Never connects again by itself: `lost` tells, and `connect` starts anew. On
/// loopback without keys it talks only to its own user's process, or root's. One thread.
class ClientSocket {
 public:
  explicit ClientSocket(std::string endpoint, const SocketOptions& options = {},
                        std::optional<ClientKeys> keys = {});
  ~ClientSocket();

  /// Where the next `connect` goes, and with which keys. `others`: where the same server may be
  /// found, too.
  void redirect(std::string endpoint, std::optional<ClientKeys> keys,
                std::vector<std::string> others = {});
  /// Drops the old connection, if any, and what it had not sent, and begins a new one. It looks the
  /// host's name up, which may take seconds; each time the next one of its numbers is tried.
  void connect();
  /// Drops the connection; what was sent goes out within `linger`.
  void close(std::chrono::milliseconds linger);
  /// Never blocks; frames sent before the connection stands are queued. Gone when not connected.
  SendStatus send(std::string_view frame);
  /// Takes a frame if there is one; false if not. Empty ones are left out.
  bool receive(std::string& frame);
  /// Whether the connection broke, or could not be made, since the last call.
  bool lost();
  /// Why, in a sentence, where that is known: an unknown name, another user's port.
  const std::string& trouble() const;
  /// How many numbers the last `connect` had to choose from, and whether it got through.
  std::size_t choices() const;
  bool stood() const;
  /// Whether the last connection ended because the server does not want this client's key.
  bool refused() const;
  void wait(const Wakeup& wakeup, std::chrono::milliseconds timeout);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

inline constexpr std::string_view kTcpScheme = "tcp://";
/// Of tcp://HOST:PORT; nothing for other texts.
std::optional<Address> address_of(std::string_view endpoint);
std::string tcp_endpoint(const Address& address);

}  // namespace swarmsmith
