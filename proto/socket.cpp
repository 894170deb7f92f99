#include "proto/socket.h"

#include <array>
#include <optional>
#include <zmq.hpp>

#include "proto/wire.h"

namespace swarmsmith {
namespace {

/// Names that a ROUTER makes itself: a zero byte and four of a counter. A peer that brings a name
/// of its own has another form, and is ignored.
constexpr std::size_t kRoutingIdBytes = 5;

using RoutingId = std::array<unsigned char, kRoutingIdBytes>;

std::optional<PeerId> peer_of(const zmq::message_t& name) {
  const auto* bytes = static_cast<const unsigned char*>(name.data());
  if (name.size() != kRoutingIdBytes || bytes[0] != 0) return std::nullopt;
  return static_cast<PeerId>(bytes[1]) << 24U | static_cast<PeerId>(bytes[2]) << 16U |
         static_cast<PeerId>(bytes[3]) << 8U | static_cast<PeerId>(bytes[4]);
}

RoutingId routing_id_of(PeerId peer) {
  return {0, static_cast<unsigned char>(peer >> 24U), static_cast<unsigned char>(peer >> 16U),
          static_cast<unsigned char>(peer >> 8U), static_cast<unsigned char>(peer)};
}

int milliseconds(std::chrono::milliseconds duration) {
  return static_cast<int>(duration.count());
}

/// `most`: bytes of a frame that may come in; a longer one ends its connection.
void apply(const SocketOptions& options, std::size_t most, zmq::socket_t& socket) {
  socket.set(zmq::sockopt::linger, milliseconds(options.linger));
  socket.set(zmq::sockopt::maxmsgsize, static_cast<std::int64_t>(most));
  socket.set(zmq::sockopt::handshake_ivl, milliseconds(options.handshake_timeout));
  socket.set(zmq::sockopt::sndhwm, options.send_queue);
  socket.set(zmq::sockopt::heartbeat_ivl, milliseconds(options.heartbeat_interval));
  socket.set(zmq::sockopt::heartbeat_timeout, milliseconds(options.heartbeat_timeout));
}

/// Interrupted by a signal is as good as woken.
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

}  // namespace

bool is_tcp_address(std::string_view endpoint) {
  constexpr std::string_view kScheme = "tcp://";
  constexpr int kLargestPort = 65'535;
  const std::size_t colon = endpoint.rfind(':');
  if (!endpoint.starts_with(kScheme) || colon <= kScheme.size()) return false;
  const std::string port(endpoint.substr(colon + 1));
  if (port == "*") return true;
  if (port.empty() || port.size() > 5) return false;
  if (port.find_first_not_of("0123456789") != std::string::npos) return false;
  return std::stoi(port) <= kLargestPort;
}

struct ServerSocket::Impl {
  zmq::context_t context{1};
  zmq::socket_t socket{context, zmq::socket_type::router};
  std::string endpoint;
  zmq::message_t name;
  zmq::message_t frame;
};

ServerSocket::ServerSocket(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ServerSocket::~ServerSocket() = default;

Expected<std::unique_ptr<ServerSocket>> ServerSocket::bind(const std::string& endpoint,
                                                           const SocketOptions& options) {
  auto impl = std::make_unique<Impl>();
  apply(options, kMaxFrameBytes, impl->socket);
  // Else a message to a peer that has gone vanishes without an error.
  impl->socket.set(zmq::sockopt::router_mandatory, true);
  try {
    impl->socket.bind(endpoint);
  } catch (const zmq::error_t& error) {
    const bool taken = error.num() == EADDRINUSE;
    return unexpected(taken ? ErrorKind::Conflict : ErrorKind::Unavailable,
                      taken ? "another program listens on this port; name another one, or end that"
                            : std::string("cannot listen on this address: ") + error.what(),
                      endpoint);
  }
  impl->endpoint = impl->socket.get(zmq::sockopt::last_endpoint);
  return std::unique_ptr<ServerSocket>(new ServerSocket(std::move(impl)));
}

const std::string& ServerSocket::endpoint() const {
  return impl_->endpoint;
}

SendStatus ServerSocket::send(PeerId peer, std::string_view frame) {
  const RoutingId name = routing_id_of(peer);
  const std::string_view bytes(reinterpret_cast<const char*>(name.data()), name.size());
  const SendStatus status = send_on(impl_->socket, bytes, zmq::send_flags::sndmore);
  return status == SendStatus::Sent ? send_on(impl_->socket, frame, zmq::send_flags::none) : status;
}

bool ServerSocket::receive(Received& received) {
  while (impl_->socket.recv(impl_->name, zmq::recv_flags::dontwait)) {
    const std::optional<PeerId> peer = peer_of(impl_->name);
    impl_->frame.rebuild();
    int frames = 0;
    bool more = impl_->name.more();
    while (more) {
      (void)impl_->socket.recv(impl_->frame, zmq::recv_flags::dontwait);
      more = impl_->frame.more();
      ++frames;
    }
    if (frames != 1) impl_->frame.rebuild();
    if (!peer) continue;
    received.peer = *peer;
    received.frame = impl_->frame.to_string_view();
    return true;
  }
  return false;
}

void ServerSocket::wait(const Wakeup& wakeup, std::chrono::milliseconds timeout) {
  std::array<zmq_pollitem_t, 2> items{{{impl_->socket.handle(), 0, ZMQ_POLLIN, 0},
                                       {nullptr, wakeup.file_descriptor(), ZMQ_POLLIN, 0}}};
  poll(items.data(), items.size(), timeout);
}

struct ClientSocket::Impl {
  std::string endpoint;
  SocketOptions options;
  zmq::context_t context{1};
  zmq::socket_t socket;
  zmq::socket_t monitor;
  std::uint64_t connections = 0;

  void drop(std::chrono::milliseconds linger) {
    if (!socket) return;
    zmq_socket_monitor(socket.handle(), nullptr, 0);
    monitor.close();
    socket.set(zmq::sockopt::linger, milliseconds(linger));
    socket.close();
  }
};

ClientSocket::ClientSocket(std::string endpoint, const SocketOptions& options)
    : impl_(std::make_unique<Impl>()) {
  impl_->endpoint = std::move(endpoint);
  impl_->options = options;
}

ClientSocket::~ClientSocket() {
  impl_->drop(impl_->options.linger);
}

void ClientSocket::connect() {
  impl_->drop(std::chrono::milliseconds{0});
  impl_->socket = zmq::socket_t(impl_->context, zmq::socket_type::dealer);
  apply(impl_->options, kMaxFrameToWorkerBytes, impl_->socket);
  // The worker's protocol decides when to try again.
  impl_->socket.set(zmq::sockopt::reconnect_ivl, -1);
  const std::string watch = "inproc://monitor-" + std::to_string(++impl_->connections);
  if (zmq_socket_monitor(impl_->socket.handle(), watch.c_str(),
                         ZMQ_EVENT_DISCONNECTED | ZMQ_EVENT_CLOSED |
                             ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL |
                             ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL) != 0) {
    throw zmq::error_t();
  }
  impl_->monitor = zmq::socket_t(impl_->context, zmq::socket_type::pair);
  impl_->monitor.set(zmq::sockopt::linger, 0);
  impl_->monitor.connect(watch);
  impl_->socket.connect(impl_->endpoint);
}

void ClientSocket::close(std::chrono::milliseconds linger) {
  impl_->drop(linger);
}

SendStatus ClientSocket::send(std::string_view frame) {
  if (!impl_->socket) return SendStatus::Gone;
  return send_on(impl_->socket, frame, zmq::send_flags::none);
}

bool ClientSocket::receive(std::string& frame) {
  if (!impl_->socket) return false;
  zmq::message_t message;
  if (!impl_->socket.recv(message, zmq::recv_flags::dontwait)) return false;
  const bool single = !message.more();
  while (message.more())
    (void)impl_->socket.recv(message, zmq::recv_flags::dontwait);
  frame = single ? message.to_string() : std::string();
  return true;
}

bool ClientSocket::lost() {
  if (!impl_->monitor) return false;
  bool lost = false;
  zmq::message_t event;
  // Any event that is watched means that there is no connection; an event has two frames.
  while (impl_->monitor.recv(event, zmq::recv_flags::dontwait))
    lost = true;
  return lost;
}

void ClientSocket::wait(const Wakeup& wakeup, std::chrono::milliseconds timeout) {
  std::array<zmq_pollitem_t, 3> items{{{nullptr, wakeup.file_descriptor(), ZMQ_POLLIN, 0},
                                       {nullptr, 0, ZMQ_POLLIN, 0},
                                       {nullptr, 0, ZMQ_POLLIN, 0}}};
  std::size_t count = 1;
  if (impl_->socket) {
    items[1].socket = impl_->socket.handle();
    items[2].socket = impl_->monitor.handle();
    count = items.size();
  }
  poll(items.data(), count, timeout);
}

}  // namespace swarmsmith
