#include <sys/socket.h>
#include <sys/stat.h>
#include <array>
#include <cstdlib>
#include <optional>
#include <unordered_map>
#include <utility>
#include <zmq.hpp>

#include "proto/internal/gate.h"
#include "proto/internal/zmq_support.h"
#include "proto/socket.h"
#include "proto/wire.h"

namespace swarmsmith {
namespace {

/// Names that a ROUTER makes itself: a zero byte and four of a counter. A peer that brings a name
/// of its own has another form, and is ignored.
constexpr std::size_t kRoutingIdBytes = 5;

/// Connections that the system holds until libzmq takes them: a whole cluster comes back at once.
constexpr int kBacklog = 4096;

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

/// Peers whose clients are remembered; gone ones are forgotten when a message does not reach them,
/// or all together when there are more.
constexpr std::size_t kMostPeers = 20'000;

/// A connection's descriptor; the number of its inode tells whether it is still that connection.
struct Connection {
  int descriptor = -1;
  ino_t inode = 0;
};

Connection connection_of(zmq::message_t& frame) {
  const int descriptor = zmq_msg_get(frame.handle(), ZMQ_SRCFD);
  struct stat status = {};
  if (descriptor < 0 || fstat(descriptor, &status) != 0) return {};
  return {descriptor, status.st_ino};
}

/// libzmq 4.3 cannot end one connection of a socket, so that the system is asked to: libzmq then
/// finds it closed.
void cut(const Connection& connection) {
  struct stat status = {};
  if (connection.descriptor < 0 || fstat(connection.descriptor, &status) != 0) return;
  if (S_ISSOCK(status.st_mode) && status.st_ino == connection.inode) {
    shutdown(connection.descriptor, SHUT_RDWR);
  }
}

std::string key_of(zmq::message_t& frame) {
  const char* user = zmq_msg_gets(frame.handle(), "User-Id");
  return user != nullptr ? user : "";
}

/// Where it comes from; the text lives as long as the frame.
std::string_view address_of(zmq::message_t& frame) {
  const char* address = zmq_msg_gets(frame.handle(), "Peer-Address");
  return address != nullptr ? address : "";
}

}  // namespace

std::uint64_t Refusals::total() const {
  std::uint64_t sum = 0;
  for (const auto& [reason, count] : counts)
    sum += count;
  return sum;
}

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
  /// What is known of a peer since its first message. Measured: to ask libzmq for the user of a
  /// message takes 18 ns, to find the peer here 14 ns; but then there is no lock and no look-up by
  /// key a message, and a revocation knows whom to cut off.
  struct Peer {
    std::string key;
    std::optional<ListedClient> client;  ///< nothing once it is cut off
    Connection connection;
  };

  zmq::context_t context{1};
  zmq::socket_t socket{context, zmq::socket_type::router};
  std::unique_ptr<Gate> gate;
  bool by_key = false;
  std::unordered_map<PeerId, Peer> peers;  ///< with keys only
  std::string endpoint;
  zmq::message_t name;
  zmq::message_t frame;

  /// The peer of a message, `frame` being its first part.
  Peer& peer_behind(PeerId id) {
    const auto known = peers.find(id);
    if (known != peers.end()) return known->second;
    if (peers.size() >= kMostPeers) peers.clear();
    Peer& peer = peers[id];
    peer.key = key_of(frame);
    peer.connection = connection_of(frame);
    check(peer);
    return peer;
  }

  /// Looks the peer up in the list as it is now; false when it has been cut off.
  bool check(Peer& peer) {
    peer.client = gate->find(peer.key);
    if (peer.client) return true;
    gate->count_refusal("revoked key", "");
    cut(peer.connection);
    return false;
  }
};

ServerSocket::ServerSocket(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ServerSocket::~ServerSocket() = default;

Expected<std::unique_ptr<ServerSocket>> ServerSocket::bind(const std::string& endpoint,
                                                           const SocketOptions& options,
                                                           std::optional<ServerKeys> keys) {
  auto impl = std::make_unique<Impl>();
  apply(options, kMaxFrameBytes, impl->socket);
  impl->socket.set(zmq::sockopt::backlog, kBacklog);
  // Else a message to a peer that has gone vanishes without an error.
  impl->socket.set(zmq::sockopt::router_mandatory, true);
  impl->by_key = keys.has_value();
  impl->gate = std::make_unique<Gate>(impl->context, impl->socket, impl->by_key, options);
  if (keys) {
    impl->gate->admit(std::move(keys->clients));
    impl->socket.set(zmq::sockopt::curve_server, true);
    impl->socket.set(zmq::sockopt::curve_secretkey, keys->secret_key);
    impl->socket.set(zmq::sockopt::zap_domain, "swarmsmith");
  }
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
  if (impl_->by_key) {
    const auto known = impl_->peers.find(peer);
    if (known != impl_->peers.end() && !known->second.client) return SendStatus::Gone;
  }
  const RoutingId name = routing_id_of(peer);
  const std::string_view bytes(reinterpret_cast<const char*>(name.data()), name.size());
  SendStatus status = send_on(impl_->socket, bytes, zmq::send_flags::sndmore);
  if (status == SendStatus::Sent) status = send_on(impl_->socket, frame, zmq::send_flags::none);
  if (status == SendStatus::Gone) impl_->peers.erase(peer);
  return status;
}

bool ServerSocket::receive(Received& received) {
  while (impl_->socket.recv(impl_->name, zmq::recv_flags::dontwait)) {
    const std::optional<PeerId> id = peer_of(impl_->name);
    impl_->frame.rebuild();
    const Impl::Peer* peer = nullptr;
    int frames = 0;
    bool more = impl_->name.more();
    while (more) {
      (void)impl_->socket.recv(impl_->frame, zmq::recv_flags::dontwait);
      more = impl_->frame.more();
      if (frames++ == 0 && id && impl_->by_key) peer = &impl_->peer_behind(*id);
    }
    if (frames != 1) impl_->frame.rebuild();
    if (!id || (impl_->by_key && (peer == nullptr || !peer->client))) continue;
    received = {.peer = *id,
                .frame = impl_->frame.to_string_view(),
                .role = {},
                .client = {},
                .address = address_of(impl_->frame)};
    if (peer != nullptr) {
      received.role = peer->client->role;
      received.client = peer->client->name;
    }
    return true;
  }
  return false;
}

std::vector<PeerId> ServerSocket::admit(std::vector<ListedClient> clients) {
  impl_->gate->admit(std::move(clients));
  std::vector<PeerId> gone;
  for (auto& [id, peer] : impl_->peers) {
    if (peer.client && !impl_->check(peer)) gone.push_back(id);
  }
  return gone;
}

Refusals ServerSocket::refusals() const {
  return impl_->gate->refusals();
}

void ServerSocket::wait(const Wakeup& wakeup, std::chrono::milliseconds timeout) {
  std::array<zmq_pollitem_t, 2> items{{{impl_->socket.handle(), 0, ZMQ_POLLIN, 0},
                                       {nullptr, wakeup.file_descriptor(), ZMQ_POLLIN, 0}}};
  poll(items.data(), items.size(), timeout);
}

}  // namespace swarmsmith
