#include "base/peer_user.h"

#include <arpa/inet.h>
#include <linux/inet_diag.h>
#include <linux/netlink.h>
#include <linux/sock_diag.h>
#include <netinet/in.h>
#include <pwd.h>
#include <sys/socket.h>
#include <unistd.h>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>

namespace swarmsmith {
namespace {

/// A descriptor that the destructor closes.
struct Descriptor {
  explicit Descriptor(int opened) : number(opened) {}
  ~Descriptor() {
    if (number >= 0) close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number;
};

struct Ends {
  sockaddr_storage ours = {};
  sockaddr_storage theirs = {};
};

/// Converts an IPv4 address within IPv6, which a socket of both families reports, to plain IPv4.
void unmap(sockaddr_storage& end) {
  const auto six = reinterpret_cast<const sockaddr_in6&>(end);
  if (end.ss_family != AF_INET6 || !IN6_IS_ADDR_V4MAPPED(&six.sin6_addr)) return;
  sockaddr_in four = {};
  four.sin_family = AF_INET;
  four.sin_port = six.sin6_port;
  std::memcpy(&four.sin_addr, &six.sin6_addr.s6_addr[12], sizeof four.sin_addr);
  end = {};
  std::memcpy(&end, &four, sizeof four);
}

std::optional<Ends> ends_of(int socket) {
  Ends ends;
  socklen_t size = sizeof ends.ours;
  if (getsockname(socket, reinterpret_cast<sockaddr*>(&ends.ours), &size) != 0) return std::nullopt;
  size = sizeof ends.theirs;
  if (getpeername(socket, reinterpret_cast<sockaddr*>(&ends.theirs), &size) != 0)
    return std::nullopt;
  unmap(ends.ours);
  unmap(ends.theirs);
  return ends;
}

/// The user of a socket. A socket that no process has any more has no inode, and the kernel reports
/// root as its user.
std::optional<uid_t> holder(uid_t user, std::uint64_t inode) {
  return inode != 0 ? std::optional(user) : std::nullopt;
}

void set_end(const sockaddr_storage& end, __be32* address, __be16& port) {
  if (end.ss_family == AF_INET6) {
    sockaddr_in6 six = {};
    std::memcpy(&six, &end, sizeof six);
    std::memcpy(address, &six.sin6_addr, sizeof six.sin6_addr);
    port = six.sin6_port;
  } else {
    sockaddr_in four = {};
    std::memcpy(&four, &end, sizeof four);
    std::memcpy(address, &four.sin_addr, sizeof four.sin_addr);
    port = four.sin_port;
  }
}

/// The kernel's data on the socket with these ends (sock_diag(7)); empty when there is no such
/// socket, or when the kernel does not answer.
std::optional<inet_diag_msg> ask_kernel(const sockaddr_storage& own,
                                        const sockaddr_storage& other) {
  struct {
    nlmsghdr head;
    inet_diag_req_v2 wanted;
  } question = {};
  question.head.nlmsg_len = sizeof question;
  question.head.nlmsg_type = SOCK_DIAG_BY_FAMILY;
  question.head.nlmsg_flags = NLM_F_REQUEST;
  question.wanted.sdiag_family = static_cast<__u8>(own.ss_family);
  question.wanted.sdiag_protocol = IPPROTO_TCP;
  inet_diag_sockid& id = question.wanted.id;
  set_end(own, id.idiag_src, id.idiag_sport);
  set_end(other, id.idiag_dst, id.idiag_dport);
  id.idiag_cookie[0] = id.idiag_cookie[1] = INET_DIAG_NOCOOKIE;
  const int kernel = socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_SOCK_DIAG);
  if (kernel < 0) return std::nullopt;
  std::array<char, 4096> answer{};
  // The answer is there when `send` returns.
  const bool sent = send(kernel, &question, sizeof question, 0) == sizeof question;
  const ssize_t got = sent ? recv(kernel, answer.data(), answer.size(), MSG_DONTWAIT) : -1;
  close(kernel);
  nlmsghdr head = {};
  inet_diag_msg found = {};
  if (got < static_cast<ssize_t>(NLMSG_LENGTH(sizeof found))) return std::nullopt;
  std::memcpy(&head, answer.data(), sizeof head);
  std::memcpy(&found, answer.data() + NLMSG_HDRLEN, sizeof found);
  return head.nlmsg_type == SOCK_DIAG_BY_FAMILY ? std::optional(found) : std::nullopt;
}

/// An end as in the kernel's list: words of four bytes in this machine's byte order, then the port.
std::string listed(const sockaddr_storage& end) {
  std::array<std::uint32_t, 4> words{};
  std::uint16_t port = 0;
  set_end(end, words.data(), port);
  std::string text;
  std::array<char, 16> part{};
  for (std::size_t i = 0; i < (end.ss_family == AF_INET6 ? 4U : 1U); ++i) {
    std::snprintf(part.data(), part.size(), "%08X", words[i]);
    text += part.data();
  }
  std::snprintf(part.data(), part.size(), ":%04X", ntohs(port));
  return text + part.data();
}

/// The user from the list of all sockets. The kernel searches its whole table for it, which takes
/// milliseconds.
std::optional<uid_t> user_in_list(const Ends& ends) {
  std::ifstream list(ends.ours.ss_family == AF_INET6 ? "/proc/net/tcp6" : "/proc/net/tcp");
  const std::string own = listed(ends.theirs);
  const std::string other = listed(ends.ours);
  std::string line;
  while (std::getline(list, line)) {
    if (line.find(own) == std::string::npos) continue;
    std::istringstream words(line);
    std::string number;
    std::string from;
    std::string to;
    std::string skipped;
    uid_t user = 0;
    std::uint64_t inode = 0;
    words >> number >> from >> to >> skipped >> skipped >> skipped >> skipped >> user >> skipped >>
        inode;
    if (words && from == own && to == other) return holder(user, inode);
  }
  return std::nullopt;
}

}  // namespace

std::optional<uid_t> user_of_peer(int socket) {
  const auto ends = ends_of(socket);
  if (!ends) return std::nullopt;
  // The peer's end is a socket of this host; its own address is the remote address of ours.
  if (const auto theirs = ask_kernel(ends->theirs, ends->ours))
    return holder(theirs->idiag_uid, theirs->idiag_inode);
  // If the kernel knows our end but not the peer's, the peer is on another host.
  if (ask_kernel(ends->ours, ends->theirs)) return std::nullopt;
  return user_in_list(*ends);
}

bool is_same_user(uid_t user) {
  return user == geteuid() || user == 0;
}

bool is_of_same_user(int socket) {
  const auto user = user_of_peer(socket);
  return user && is_same_user(*user);
}

std::optional<uid_t> user_who_listens(const std::string& number, int port) {
  sockaddr_storage own = {};
  auto& six = reinterpret_cast<sockaddr_in6&>(own);
  auto& four = reinterpret_cast<sockaddr_in&>(own);
  if (inet_pton(AF_INET, number.c_str(), &four.sin_addr) == 1) {
    own.ss_family = AF_INET;
  } else if (inet_pton(AF_INET6, number.c_str(), &six.sin6_addr) == 1) {
    own.ss_family = AF_INET6;
  } else {
    return std::nullopt;
  }
  four.sin_port = htons(static_cast<std::uint16_t>(port));  // at the same offset as in IPv6
  sockaddr_storage none = {};
  none.ss_family = own.ss_family;
  const auto found = ask_kernel(own, none);
  return found ? holder(found->idiag_uid, found->idiag_inode) : std::nullopt;
}

bool kernel_names_users() {
  const Descriptor listening(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const Descriptor theirs(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  auto* const place = reinterpret_cast<sockaddr*>(&address);
  socklen_t size = sizeof address;
  if (bind(listening.number, place, size) != 0 || listen(listening.number, 1) != 0 ||
      getsockname(listening.number, place, &size) != 0 ||
      connect(theirs.number, place, size) != 0) {
    return false;
  }
  const Descriptor ours(accept4(listening.number, nullptr, nullptr, SOCK_CLOEXEC));
  return user_of_peer(ours.number) == geteuid();
}

std::string name_of_user(uid_t user) {
  std::array<char, 4096> room{};
  passwd entry = {};
  passwd* found = nullptr;
  getpwuid_r(user, &entry, room.data(), room.size(), &found);
  return found != nullptr ? std::string(found->pw_name) : std::to_string(user);
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
