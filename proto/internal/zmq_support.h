#pragma once

#include <zmq.hpp>

#include <chrono>
#include <cstddef>
#include <string_view>

#include "proto/socket.h"

namespace swarmsmith {

/// What both ends of a connection do with ZeroMQ.

inline int milliseconds(std::chrono::milliseconds duration) {
  return static_cast<int>(duration.count());
}

/// `most`: bytes of a frame that may come in; a longer one ends its connection.
void apply(const SocketOptions& options, std::size_t most, zmq::socket_t& socket);

/// Interrupted by a signal is as good as woken.
void poll(zmq_pollitem_t* items, std::size_t count, std::chrono::milliseconds timeout);

SendStatus send_on(zmq::socket_t& socket, std::string_view frame, zmq::send_flags flags);

/// What a socket's monitor tells: the event and its number (a descriptor, an error, a status).
struct MonitorEvent {
  int event = 0;
  int value = 0;
};

/// Begins to watch; the events come out of the returned socket, which must be read while it is
/// watched, since libzmq's I/O thread waits when too many queue up.
zmq::socket_t watch(zmq::context_t& context, zmq::socket_t& socket, std::string_view name,
                    int events);
/// Before the socket that `watch` returned is closed.
void stop_watching(zmq::socket_t& socket);
/// Takes an event if there is one; false if not.
bool receive_event(zmq::socket_t& monitor, MonitorEvent& event);

}  // namespace swarmsmith
