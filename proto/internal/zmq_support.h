#pragma once

#include <zmq.hpp>

#include <chrono>
#include <cstddef>
#include <string_view>

#include "proto/socket.h"

namespace swarmsmith {

/// Functions on ZeroMQ sockets that both ends of a connection use.

inline int milliseconds(std::chrono::milliseconds duration) {
  return static_cast<int>(duration.count());
}

/// `most` is the largest size of an incoming frame in bytes; a longer one closes its connection.
void apply(const SocketOptions& options, std::size_t most, zmq::socket_t& socket);

/// An interruption by a signal counts as being woken.
void poll(zmq_pollitem_t* items, std::size_t count, std::chrono::milliseconds timeout);

SendStatus send_on(zmq::socket_t& socket, std::string_view frame, zmq::send_flags flags);

/// An event of a socket's monitor, and its number (a descriptor, an error, a status).
struct MonitorEvent {
  int event = 0;
  int value = 0;
};

/// Starts to watch a socket. The returned socket delivers the events. It must be read as long as it
/// exists, since libzmq's I/O thread waits when too many events are queued.
zmq::socket_t watch(zmq::context_t& context, zmq::socket_t& socket, std::string_view name,
                    int events);
/// To be called before the socket that `watch` returned is closed.
void stop_watching(zmq::socket_t& socket);
/// Takes an event if there is one; false if not.
bool receive_event(zmq::socket_t& monitor, MonitorEvent& event);

}  // namespace swarmsmith
