#pragma once

#include <sys/types.h>
#include <optional>
#include <string>

namespace swarmsmith {

/// The user whose process holds the other end of a TCP connection within this host, as the kernel
/// says (sock_diag(7); where it cannot be asked, /proc/net/tcp and tcp6). Nothing when the other
/// end is on another host, or no process holds it any more.
std::optional<uid_t> user_of_peer(int socket);

/// The address of the other end, as a number: "127.0.0.1"; empty when it is gone.
std::string address_of_peer(int socket);

}  // namespace swarmsmith
