#include <unistd.h>
#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <zmq.hpp>

#include "base/peer_user.h"
#include "proto/internal/zmq_support.h"
#include "proto/socket.h"
#include "proto/wire.h"

namespace swarmsmith {

namespace {

/// All events except the first two mean that there is no connection (any more).
constexpr int kEvents = ZMQ_EVENT_CONNECTED | ZMQ_EVENT_HANDSHAKE_SUCCEEDED |
                        ZMQ_EVENT_DISCONNECTED | ZMQ_EVENT_CLOSED |
                        ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL | ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL |
                        ZMQ_EVENT_HANDSHAKE_FAILED_AUTH;

/// The numeric addresses of the endpoints, whose hosts may be names; or the reason why there are
/// none.
Expected<std::vector<Address>> looked_up(const std::vector<std::string>& endpoints) {
  std::vector<Address> all;
  Error first{ErrorKind::Unavailable, "no address to connect to", ""};
  for (const std::string& endpoint : endpoints) {
    const auto address = address_of(endpoint);
    if (!address) continue;
    auto numbers = numbers_of(address->host);
    if (!numbers) {
      if (first.where.empty()) first = {ErrorKind::Unavailable, numbers.error().message, endpoint};
      continue;
    }
    for (std::string& number : *numbers) {
      Address found{std::move(number), address->port};
      if (std::ranges::find(all, found) == all.end()) all.push_back(std::move(found));
    }
  }
  if (all.empty()) return Unexpected(first);
  return all;
}

/// A sentence that names the user of the program that listens there, if it is another user; else
/// empty. A coordinator of root does not admit other users, but a program of root may be the end of
/// a tunnel. A client of root connects to root's programs only.
std::string other_owner(const Address& address) {
  if (!is_loopback(address.host)) return "";
  const auto user = user_who_listens(address.host, address.port);
  if (!user || *user == geteuid()) return "";
  return "the program that listens there belongs to another user of this host (" +
         name_of_user(*user) +
         "); without keys client and coordinator on loopback must belong to the same user "
         "(`swarmsmith keygen`)";
}

}  // namespace

struct ClientSocket::Impl {
  std::vector<std::string> endpoints;
  SocketOptions options;
  std::optional<ClientKeys> keys;
  zmq::context_t context{1};
  zmq::socket_t socket;
  zmq::socket_t monitor;
  std::uint64_t connections = 0;
  std::size_t choices = 0;
  Address address;  ///< of the last connection
  bool refused = false;
  bool stood = false;
  bool lost = false;
  std::string trouble;
  int descriptor = -1;  ///< of the connection that is being made

  /// Whether to ask the kernel for the user of the server.
  bool asks_for_user() const { return !keys && is_loopback(address.host); }

  void begin() {
    const auto numbers = looked_up(endpoints);
    choices = numbers ? numbers->size() : 0;
    if (!numbers) {
      lost = true;
      trouble = to_string(numbers.error());
      return;
    }
    // A name may have several addresses, and this host may not reach all of them: each attempt
    // takes the next one (docs/security.md, "The coordinator's file").
    address = (*numbers)[connections++ % choices];
    if (const auto user =
            asks_for_user() ? user_who_listens(address.host, address.port) : std::nullopt;
        user && !is_same_user(*user)) {
      // Other users do not even get a greeting.
      lost = true;
      trouble = other_owner(address);
      return;
    }
    socket = zmq::socket_t(context, zmq::socket_type::dealer);
    apply(options, kMaxFrameToWorkerBytes, socket);
    socket.set(zmq::sockopt::ipv6, address.host.find(':') != std::string::npos);
    // The worker's protocol decides when to try again.
    socket.set(zmq::sockopt::reconnect_ivl, -1);
    if (keys) {
      socket.set(zmq::sockopt::curve_serverkey, keys->server_key);
      socket.set(zmq::sockopt::curve_secretkey, keys->secret_key);
      socket.set(zmq::sockopt::curve_publickey, public_key_of(keys->secret_key));
    }
    monitor = watch(context, socket, "monitor-" + std::to_string(connections), kEvents);
    socket.connect(tcp_endpoint(address));
  }

  /// To be called before frames are taken, so that their sender is known.
  void hear() {
    MonitorEvent event;
    while (monitor && receive_event(monitor, event)) {
      if (event.event == ZMQ_EVENT_CONNECTED) {
        descriptor = event.value;
      } else if (event.event != ZMQ_EVENT_HANDSHAKE_SUCCEEDED) {
        lost = true;
        if (event.event == ZMQ_EVENT_HANDSHAKE_FAILED_AUTH) refused = true;
        if (!keys && trouble.empty()) trouble = other_owner(address);
      } else if (!asks_for_user() || is_served_by_same_user()) {
        stood = true;
      } else {
        lost = true;
        trouble = other_owner(address);
        return drop(std::chrono::milliseconds{0});
      }
    }
  }

  /// A server that has completed the handshake has accepted the connection, so the connection now
  /// belongs to a process.
  bool is_served_by_same_user() const {
    static const bool is_known = kernel_names_users();
    return is_of_same_user(descriptor) || !is_known;
  }

  /// Throws nothing, since the destructor calls it.
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

void ClientSocket::redirect(std::string endpoint, std::optional<ClientKeys> keys,
                            std::vector<std::string> others) {
  impl_->endpoints = std::move(others);
  impl_->endpoints.insert(impl_->endpoints.begin(), std::move(endpoint));
  impl_->keys = std::move(keys);
}

ClientSocket::~ClientSocket() {
  impl_->drop(impl_->options.linger);
}

void ClientSocket::connect() {
  impl_->drop(std::chrono::milliseconds{0});
  impl_->refused = impl_->stood = impl_->lost = false;
  impl_->trouble.clear();
  impl_->begin();
}

void ClientSocket::close(std::chrono::milliseconds linger) {
  impl_->drop(linger);
}

SendStatus ClientSocket::send(std::string_view frame) {
  if (!impl_->socket) return SendStatus::Gone;
  return send_on(impl_->socket, frame, zmq::send_flags::none);
}

bool ClientSocket::receive(std::string& frame) {
  impl_->hear();
  if (!impl_->socket) return false;
  zmq::message_t message;
  do {
    if (!impl_->socket.recv(message, zmq::recv_flags::dontwait)) return false;
  } while (message.size() == 0 && !message.more());
  const bool single = !message.more();
  while (message.more())
    (void)impl_->socket.recv(message, zmq::recv_flags::dontwait);
  frame = single ? message.to_string() : std::string();
  return true;
}

bool ClientSocket::lost() {
  impl_->hear();
  return std::exchange(impl_->lost, false);
}

const std::string& ClientSocket::trouble() const {
  return impl_->trouble;
}

std::size_t ClientSocket::choices() const {
  return impl_->choices;
}

bool ClientSocket::stood() const {
  return impl_->stood;
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
  if (impl_->lost) timeout = std::chrono::milliseconds{0};
  poll(items.data(), count, timeout);
}

}  // namespace swarmsmith
