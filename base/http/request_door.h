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
  int port = 0;  ///< the real one
};

/// `port` 0: a free one. The port belongs to this process alone (no SO_REUSEPORT). Errors: Conflict
/// (another program listens there), BadInput (no address of this host), Unavailable.
Expected<ListeningSocket> listen_for_requests(const std::string& host, int port);

struct DoorLimits {
  /// Most connections without a complete request; when one more comes, the oldest is closed.
  std::size_t connections = 512;
  std::size_t head_bytes = 16U << 10U;
  std::chrono::milliseconds head_time{3000};
};

/// Takes HTTP connections and collects their requests' heads (request line and headers), all in one
/// thread. A peer that sends a byte a second costs only a descriptor, and a request that comes in
/// one piece is handed over at once, however many others are slow.
class RequestDoor {
 public:
  /// Called by the door's thread, with a complete head; owns the socket (non-blocking) from then
  /// on.
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
