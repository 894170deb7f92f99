#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>

namespace swarmsmith {

/// A connection's descriptor; the number of its inode tells whether it is still that connection.
struct Connection {
  int descriptor = -1;
  ino_t inode = 0;
};

/// Of the socket behind a descriptor, as it is now; -1 when there is none.
Connection connection_at(int descriptor);

/// libzmq 4.3 cannot end one connection of a socket, so that the system is asked to: libzmq then
/// finds it closed.
void cut(const Connection& connection);

/// What the system has counted of a connection since it was made: libzmq does not say how much of a
/// peer's it holds, but what came, less what was taken, lies in its queues; and what was given,
/// less what the peer's host has acknowledged.
struct TcpBytes {
  std::uint64_t received = 0;
  std::uint64_t acknowledged = 0;  ///< by the other side
};

/// Nothing when it is gone.
std::optional<TcpBytes> tcp_bytes_of(const Connection& connection);

}  // namespace swarmsmith
