#include <array>
#include <string>
#include <utility>
#include <zmq.hpp>

#include "proto/internal/zmq_support.h"
#include "proto/socket.h"
#include "proto/wire.h"

namespace swarmsmith {

namespace {

/// Each means that there is no connection (any more).
constexpr int kEvents = ZMQ_EVENT_DISCONNECTED | ZMQ_EVENT_CLOSED |
                        ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL | ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL |
                        ZMQ_EVENT_HANDSHAKE_FAILED_AUTH;

}  // namespace

struct ClientSocket::Impl {
  std::string endpoint;
  SocketOptions options;
  std::optional<ClientKeys> keys;
  zmq::context_t context{1};
  zmq::socket_t socket;
  zmq::socket_t monitor;
  std::uint64_t connections = 0;
  bool refused = false;

  /// Throws nothing: the destructor calls it.
  void drop(std::chrono::milliseconds linger) {
    if (!socket) return;
    stop_watching(socket);
    monitor.close();
    const int most = milliseconds(linger);
    zmq_setsockopt(socket.handle(), ZMQ_LINGER, &most, sizeof most);
    socket.close();
  }
};

ClientSocket::ClientSocket(std::string endpoint, const SocketOptions& options,
                           std::optional<ClientKeys> keys)
    : impl_(std::make_unique<Impl>()) {
  impl_->options = options;
  redirect(std::move(endpoint), std::move(keys));
}

void ClientSocket::redirect(std::string endpoint, std::optional<ClientKeys> keys) {
  impl_->endpoint = std::move(endpoint);
  impl_->keys = std::move(keys);
}

ClientSocket::~ClientSocket() {
  impl_->drop(impl_->options.linger);
}

void ClientSocket::connect() {
  impl_->drop(std::chrono::milliseconds{0});
  impl_->refused = false;
  impl_->socket = zmq::socket_t(impl_->context, zmq::socket_type::dealer);
  apply(impl_->options, kMaxFrameToWorkerBytes, impl_->socket);
  // The worker's protocol decides when to try again.
  impl_->socket.set(zmq::sockopt::reconnect_ivl, -1);
  if (impl_->keys) {
    impl_->socket.set(zmq::sockopt::curve_serverkey, impl_->keys->server_key);
    impl_->socket.set(zmq::sockopt::curve_secretkey, impl_->keys->secret_key);
    impl_->socket.set(zmq::sockopt::curve_publickey, public_key_of(impl_->keys->secret_key));
  }
  impl_->monitor = watch(impl_->context, impl_->socket,
                         "monitor-" + std::to_string(++impl_->connections), kEvents);
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
  MonitorEvent event;
  while (receive_event(impl_->monitor, event)) {
    lost = true;
    if (event.event == ZMQ_EVENT_HANDSHAKE_FAILED_AUTH) impl_->refused = true;
  }
  return lost;
}

bool ClientSocket::refused() const {
  return impl_->refused;
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
