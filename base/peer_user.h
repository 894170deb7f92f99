#pragma once

#include <sys/types.h>
#include <optional>
#include <string>

namespace swarmsmith {

/// The user whose process holds the other end of a TCP connection within this host, as the kernel
/// says (sock_diag(7); where it cannot be asked, /proc/net/tcp and tcp6). Nothing when the other
/// end is on another host, or no process holds it any more.
std::optional<uid_t> user_of_peer(int socket);

/// Whether it is the user of this process, or root.
bool is_same_user(uid_t user);
/// Whether that one holds the other end.
bool is_of_same_user(int socket);

/// The user whose process listens at a port of this host, at a number of loopback. Nothing when
/// there is none, or the kernel does not say.
std::optional<uid_t> user_who_listens(const std::string& number, int port);

/// Whether the kernel says here whose the ends of connections are: it is tried with one.
bool kernel_names_users();

/// The user's name; the number where it has none.
std::string name_of_user(uid_t user);

/// The address of the other end, as a number: "127.0.0.1"; empty when it is gone.
std::string address_of_peer(int socket);

}  // namespace swarmsmith
