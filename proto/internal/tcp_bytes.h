#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>

namespace swarmsmith {

/// A connection's descriptor; the inode shows whether the descriptor still belongs to that
/// connection.
struct Connection {
  int descriptor = -1;
  ino_t inode = 0;
};

/// The connection of the socket with this descriptor now; -1 when there is none.
Connection connection_at(int descriptor);

/// libzmq 4.3 cannot close one connection of a socket. This asks the system to do so, and libzmq
/// then finds the connection closed.
void cut(const Connection& connection);

/// The system's byte counts for a connection since it was made. libzmq does not say how many bytes
/// of a peer it holds. But the bytes that were received and not yet taken by us are in its queues,
/// and so are those that were sent and not yet acknowledged by the peer's host.
struct TcpBytes {
  std::uint64_t received = 0;
  std::uint64_t acknowledged = 0;  ///< by the other side
};

/// Empty when the connection is gone.
std::optional<TcpBytes> tcp_bytes_of(const Connection& connection);

}  // namespace swarmsmith
