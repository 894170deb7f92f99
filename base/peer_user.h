#pragma once

#include <sys/types.h>
#include <optional>
#include <string>

namespace swarmsmith {

/// The user whose process has the other end of a TCP connection within this host, according to the
/// kernel (sock_diag(7); if that is not available, /proc/net/tcp and tcp6). Empty when the other
/// end is on another host, or when no process has it any more.
std::optional<uid_t> user_of_peer(int socket);

/// Whether it is the user of this process, or root.
bool is_same_user(uid_t user);
/// Whether such a user has the other end.
bool is_of_same_user(int socket);

/// The user whose process listens at a port of this host, on a loopback address. Empty when there
/// is none, or when the kernel gives no answer.
std::optional<uid_t> user_who_listens(const std::string& number, int port);

/// Whether the kernel on this host reports the users of connections; tested with a connection.
bool kernel_names_users();

/// The user's name; the user id if there is no name.
std::string name_of_user(uid_t user);

/// The IP address of the other end, such as "127.0.0.1"; empty when it is gone.
std::string address_of_peer(int socket);

}  // namespace swarmsmith
