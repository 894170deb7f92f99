#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <list>
#include <string>
#include <thread>

#include "base/expected.h"

namespace swarmsmith {

/// A socket that listens for TCP connections.
struct ListeningSocket {
  int descriptor = -1;
  int port = 0;  ///< the actual port
};

/// `port` 0: a free one. Only this process can use the port (no SO_REUSEPORT). Errors: Conflict
/// (another program listens at it), BadInput (not an address of this host), Unavailable.
Expected<ListeningSocket> listen_for_requests(const std::string& host, int port);

struct DoorLimits {
  /// Maximum number of connections without a complete request; when one more arrives, the oldest is
  /// closed.
  std::size_t connections = 512;
  std::size_t head_bytes = 16U << 10U;
  std::chrono::milliseconds head_time{3000};
};

/// Accepts HTTP connections and collects the heads of their requests (request line and headers),
/// all in one thread. A peer that sends one byte per second costs only a descriptor, and a request
/// that arrives in one piece is passed on immediately, however many others are slow.
class RequestDoor {
 public:
  /// Called by the door's thread with a complete head. The function owns the socket (non-blocking)
  /// from then on.
  using OnRequest = std::function<void(int socket, std::string head)>;

  /// Owns the listening socket.
  RequestDoor(ListeningSocket listening, const DoorLimits& limits, OnRequest on_request);
  ~RequestDoor();
  RequestDoor(const RequestDoor&) = delete;
  RequestDoor& operator=(const RequestDoor&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  struct Connection {
    int socket;
    Clock::time_point until;
    std::string head;
  };
  using Connections = std::list<Connection>;

  void work();
  void accept_all();
  /// Reads the available bytes; returns the next connection.
  Connections::iterator read(Connections::iterator at);
  Connections::iterator drop(Connections::iterator at);
  int time_left() const;

  ListeningSocket listening_;
  DoorLimits limits_;
  OnRequest on_request_;
  int stop_ = -1;
  Connections connections_;  ///< oldest first
  std::thread thread_;
};

}  // namespace swarmsmith
