#include "base/http/request_door.h"

#include <netdb.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

namespace swarmsmith {
namespace {

constexpr int kBacklog = 1024;
constexpr std::string_view kEndOfHead = "\r\n\r\n";

int port_of(int descriptor) {
  sockaddr_storage address = {};
  socklen_t size = sizeof address;
  if (getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) != 0) return 0;
  const auto port = address.ss_family == AF_INET6
                        ? reinterpret_cast<const sockaddr_in6&>(address).sin6_port
                        : reinterpret_cast<const sockaddr_in&>(address).sin_port;
  return ntohs(port);
}

/// A listening socket at this address; -1, with errno set, if that fails.
int listen_at(const addrinfo& address) {
  const int descriptor =
      socket(address.ai_family, address.ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (descriptor < 0) return -1;
  const int yes = 1;
  setsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  if (bind(descriptor, address.ai_addr, address.ai_addrlen) == 0 &&
      listen(descriptor, kBacklog) == 0) {
    return descriptor;
  }
  const int why = errno;
  close(descriptor);
  errno = why;
  return -1;
}

}  // namespace

Expected<ListeningSocket> listen_for_requests(const std::string& host, int port) {
  const std::string where =
      (host.find(':') == std::string::npos ? host : "[" + host + "]") + ":" + std::to_string(port);
  addrinfo wanted = {};
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = AI_PASSIVE;
  addrinfo* found = nullptr;
  if (getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found) != 0) {
    return bad_input("unknown host; name an address of this host", where);
  }
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> addresses(found, freeaddrinfo);
  int why = 0;
  for (const addrinfo* at = found; at != nullptr; at = at->ai_next) {
    const int descriptor = listen_at(*at);
    if (descriptor >= 0) return ListeningSocket{descriptor, port_of(descriptor)};
    if (why == 0) why = errno;
  }
  if (why == EADDRINUSE) {
    return unexpected(
        ErrorKind::Conflict,
        "another program listens on this port; choose another port, or end that program", where);
  }
  if (why == EADDRNOTAVAIL) return bad_input("this is not an address of this host", where);
  return unexpected(ErrorKind::Unavailable,
                    std::string("cannot listen here: ") + std::strerror(why), where);
}

RequestDoor::RequestDoor(ListeningSocket listening, const DoorLimits& limits, OnRequest on_request)
    : listening_(listening),
      limits_(limits),
      on_request_(std::move(on_request)),
      stop_(eventfd(0, EFD_CLOEXEC)),
      thread_([this] { work(); }) {}

RequestDoor::~RequestDoor() {
  const std::uint64_t one = 1;
  (void)!write(stop_, &one, sizeof one);
  thread_.join();
  for (auto at = connections_.begin(); at != connections_.end();)
    at = drop(at);
  close(listening_.descriptor);
  close(stop_);
}

void RequestDoor::work() {
  std::vector<pollfd> waiting;
  while (true) {
    waiting.assign({{stop_, POLLIN, 0}, {listening_.descriptor, POLLIN, 0}});
    for (const Connection& connection : connections_)
      waiting.push_back({connection.socket, POLLIN, 0});
    if (poll(waiting.data(), waiting.size(), time_left()) < 0 && errno != EINTR) return;
    if (waiting[0].revents != 0) return;
    auto at = connections_.begin();
    for (std::size_t i = 2; i < waiting.size(); ++i)
      at = waiting[i].revents != 0 ? read(at) : std::next(at);
    const auto now = Clock::now();
    while (!connections_.empty() && connections_.front().until <= now)
      drop(connections_.begin());
    if (waiting[1].revents != 0) accept_all();
  }
}

void RequestDoor::accept_all() {
  // When many clients connect at once, requests are read in between.
  for (std::size_t i = 0; i < limits_.connections / 4; ++i) {
    const int taken =
        accept4(listening_.descriptor, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (taken < 0) {
      // Without a free descriptor the newcomer would stay in the queue, and poll would return
      // immediately.
      const bool no_room = errno == EMFILE || errno == ENFILE;
      if (!no_room || connections_.empty()) return;
      drop(connections_.begin());
      continue;
    }
    if (connections_.size() >= limits_.connections) drop(connections_.begin());
    connections_.push_back({taken, Clock::now() + limits_.head_time, {}});
    read(std::prev(connections_.end()));
  }
}

RequestDoor::Connections::iterator RequestDoor::read(Connections::iterator at) {
  std::array<char, 4096> bytes{};
  while (true) {
    const ssize_t got = recv(at->socket, bytes.data(), bytes.size(), 0);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return std::next(at);
    if (got <= 0) return drop(at);
    const std::size_t before = at->head.size() - std::min(at->head.size(), kEndOfHead.size());
    at->head.append(bytes.data(), static_cast<std::size_t>(got));
    const std::size_t end = at->head.find(kEndOfHead, before);
    if (end != std::string::npos) {
      // A body would follow, but no page takes one.
      at->head.resize(end + kEndOfHead.size());
      on_request_(at->socket, std::move(at->head));
      return connections_.erase(at);
    }
    if (at->head.size() >= limits_.head_bytes) return drop(at);
  }
}

RequestDoor::Connections::iterator RequestDoor::drop(Connections::iterator at) {
  shutdown(at->socket, SHUT_RDWR);
  close(at->socket);
  return connections_.erase(at);
}

/// Milliseconds until the oldest connection's time is over; -1 without one.
int RequestDoor::time_left() const {
  if (connections_.empty()) return -1;
  const auto left =
      std::chrono::ceil<std::chrono::milliseconds>(connections_.front().until - Clock::now());
  return static_cast<int>(std::max<std::int64_t>(0, left.count()));
}

}  // namespace swarmsmith
