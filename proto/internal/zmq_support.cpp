#include "proto/internal/zmq_support.h"

#include <cstring>
#include <string>

namespace swarmsmith {

void apply(const SocketOptions& options, std::size_t most, zmq::socket_t& socket) {
  socket.set(zmq::sockopt::linger, milliseconds(options.linger));
  socket.set(zmq::sockopt::maxmsgsize, static_cast<std::int64_t>(most));
  socket.set(zmq::sockopt::handshake_ivl, milliseconds(options.handshake_timeout));
  socket.set(zmq::sockopt::sndhwm, options.send_queue);
  // No limit on the number of waiting messages: at one, libzmq stops reading from a connection, and
  // if that connection then breaks, the next heartbeat aborts this process (libzmq's issue 4364). A
  // server's gate limits their bytes.
  socket.set(zmq::sockopt::rcvhwm, 0);
  socket.set(zmq::sockopt::heartbeat_ivl, milliseconds(options.heartbeat_interval));
  socket.set(zmq::sockopt::heartbeat_timeout, milliseconds(options.heartbeat_timeout));
}

void poll(zmq_pollitem_t* items, std::size_t count, std::chrono::milliseconds timeout) {
  try {
    zmq::poll(items, count, timeout);
  } catch (const zmq::error_t& error) {
    if (error.num() != EINTR) throw;
  }
}

SendStatus send_on(zmq::socket_t& socket, std::string_view frame, zmq::send_flags flags) {
  try {
    const auto sent = socket.send(zmq::buffer(frame), flags | zmq::send_flags::dontwait);
    return sent ? SendStatus::Sent : SendStatus::Full;
  } catch (const zmq::error_t& error) {
    if (error.num() == EHOSTUNREACH) return SendStatus::Gone;
    throw;
  }
}

zmq::socket_t watch(zmq::context_t& context, zmq::socket_t& socket, std::string_view name,
                    int events) {
  const std::string address = "inproc://" + std::string(name);
  if (zmq_socket_monitor(socket.handle(), address.c_str(), events) != 0) throw zmq::error_t();
  zmq::socket_t monitor(context, zmq::socket_type::pair);
  monitor.set(zmq::sockopt::linger, 0);
  monitor.connect(address);
  return monitor;
}

void stop_watching(zmq::socket_t& socket) {
  zmq_socket_monitor(socket.handle(), nullptr, 0);
}

bool receive_event(zmq::socket_t& monitor, MonitorEvent& event) {
  zmq::message_t part;
  if (!monitor.recv(part, zmq::recv_flags::dontwait)) return false;
  std::uint16_t number = 0;
  std::int32_t value = 0;
  if (part.size() == sizeof number + sizeof value) {
    std::memcpy(&number, part.data(), sizeof number);
    std::memcpy(&value, part.data<char>() + sizeof number, sizeof value);
  }
  event = {number, value};
  // The second part is the address of this end.
  while (part.more())
    (void)monitor.recv(part, zmq::recv_flags::dontwait);
  return true;
}

}  // namespace swarmsmith
