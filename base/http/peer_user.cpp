#include "base/http/peer_user.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <array>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>

namespace swarmsmith {
namespace {

struct Ends {
  sockaddr_storage ours = {};
  sockaddr_storage theirs = {};
};

std::optional<Ends> ends_of(int socket) {
  Ends ends;
  socklen_t size = sizeof ends.ours;
  if (getsockname(socket, reinterpret_cast<sockaddr*>(&ends.ours), &size) != 0) return std::nullopt;
  size = sizeof ends.theirs;
  if (getpeername(socket, reinterpret_cast<sockaddr*>(&ends.theirs), &size) != 0)
    return std::nullopt;
  return ends;
}

/// An end as the kernel's list has it: words of four bytes in this machine's order, then the port.
std::string listed(const sockaddr_storage& end) {
  std::array<std::uint32_t, 4> words{};
  std::size_t count = 1;
  unsigned port = 0;
  if (end.ss_family == AF_INET6) {
    const auto& six = reinterpret_cast<const sockaddr_in6&>(end);
    std::memcpy(words.data(), &six.sin6_addr, sizeof six.sin6_addr);
    count = 4;
    port = ntohs(six.sin6_port);
  } else {
    const auto& four = reinterpret_cast<const sockaddr_in&>(end);
    words[0] = four.sin_addr.s_addr;
    port = ntohs(four.sin_port);
  }
  std::string text;
  std::array<char, 16> part{};
  for (std::size_t i = 0; i < count; ++i) {
    std::snprintf(part.data(), part.size(), "%08X", words[i]);
    text += part.data();
  }
  std::snprintf(part.data(), part.size(), ":%04X", port);
  return text + part.data();
}

}  // namespace

std::optional<uid_t> user_of_peer(int socket) {
  const auto ends = ends_of(socket);
  if (!ends) return std::nullopt;
  std::ifstream list(ends->ours.ss_family == AF_INET6 ? "/proc/net/tcp6" : "/proc/net/tcp");
  // Theirs is a socket of this host, whose own end is what is the other one for us.
  const std::string own = listed(ends->theirs);
  const std::string other = listed(ends->ours);
  std::string line;
  while (std::getline(list, line)) {
    if (line.find(own) == std::string::npos) continue;
    std::istringstream words(line);
    std::string number;
    std::string from;
    std::string to;
    std::string skipped;
    uid_t user = 0;
    words >> number >> from >> to >> skipped >> skipped >> skipped >> skipped >> user;
    if (words && from == own && to == other) return user;
  }
  return std::nullopt;
}

std::string address_of_peer(int socket) {
  const auto ends = ends_of(socket);
  if (!ends) return "";
  std::array<char, INET6_ADDRSTRLEN> text{};
  const bool six = ends->theirs.ss_family == AF_INET6;
  const void* address =
      six ? static_cast<const void*>(&reinterpret_cast<const sockaddr_in6&>(ends->theirs).sin6_addr)
          : &reinterpret_cast<const sockaddr_in&>(ends->theirs).sin_addr;
  return inet_ntop(six ? AF_INET6 : AF_INET, address, text.data(), text.size()) != nullptr
             ? std::string(text.data())
             : "";
}

}  // namespace swarmsmith
