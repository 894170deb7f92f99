#pragma once

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <cstdint>
#include <string>
#include <utility>

namespace swarmsmith {

/// A connection of a peer that need not behave.
class HttpPeer {
 public:
  explicit HttpPeer(int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address = {};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{.tv_sec = 20, .tv_usec = 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    EXPECT_EQ(connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  }
  HttpPeer(HttpPeer&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}
  HttpPeer& operator=(HttpPeer&&) = delete;
  ~HttpPeer() {
    if (socket_ >= 0) ::close(socket_);
  }

  HttpPeer& say(const std::string& text) {
    (void)!::send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
    return *this;
  }
  /// Until the other side closes.
  std::string hear() {
    std::string heard;
    std::array<char, 65536> bytes{};
    while (true) {
      const ssize_t got = ::recv(socket_, bytes.data(), bytes.size(), 0);
      if (got < 0 && errno == EINTR) continue;  // this process was stopped, and goes on
      if (got <= 0) return heard;
      heard.append(bytes.data(), static_cast<std::size_t>(got));
    }
  }

 private:
  int socket_;
};

/// The whole answer of one request, headers and all. Each of `headers` ends with CR LF.
inline std::string http_answer(int port, const std::string& method, const std::string& path,
                               const std::string& headers = "") {
  return HttpPeer(port)
      .say(method + " " + path + " HTTP/1.1\r\nHost: localhost\r\n" + headers + "\r\n")
      .hear();
}

inline std::string get(int port, const std::string& path, const std::string& headers = "") {
  return http_answer(port, "GET", path, headers);
}

}  // namespace swarmsmith
