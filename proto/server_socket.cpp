#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>
#include <utility>
#include <zmq.hpp>

#include "base/clock.h"
#include "base/peer_user.h"
#include "proto/internal/gate.h"
#include "proto/internal/tcp_bytes.h"
#include "proto/internal/zmq_support.h"
#include "proto/network.h"
#include "proto/socket.h"
#include "proto/wire.h"

namespace swarmsmith {
namespace {

/// Routing ids that a ROUTER makes itself: a zero byte, and a counter of four bytes. A peer that
/// sets its own id has another form, and is ignored.
constexpr std::size_t kRoutingIdBytes = 5;

/// Connections that the system holds until libzmq accepts them: a whole cluster may reconnect at
/// once.
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

/// Maximum number of peers that are remembered. A peer that is gone is forgotten when a message
/// cannot reach it; above this number all are forgotten.
constexpr std::size_t kMostPeers = 20'000;

/// Approximate overhead of a frame in bytes: a header, and the heartbeats since the previous frame,
/// which well-behaved peers send every second. The second number is for encrypted connections.
constexpr std::uint64_t kBesidesAFrame = 32;
constexpr std::uint64_t kBesidesAFrameByKey = 128;
/// A longer frame may have to wait until other peers have received theirs. Messages with leases are
/// never that long.
constexpr std::size_t kLongFrame = 1U << 20U;
/// A peer with less than this on its way is not restricted in favour of others.
constexpr std::uint64_t kLittle = 64U << 10U;
/// While others wait, a long frame must be received at this rate.
constexpr double kLeastBytesPerSecond = 256U << 10U;
constexpr Duration kPatience = std::chrono::seconds(5);
constexpr Duration kLookAgain = std::chrono::milliseconds(50);

/// The address to listen at. Names of hosts are looked up here, since libzmq does not do that.
/// Another name may be that of an interface, which libzmq knows.
Expected<Address> address_to_bind(const std::string& endpoint) {
  auto address = address_of(endpoint);
  if (!address) return bad_input("invalid address; expected tcp://HOST:PORT", endpoint);
  if (address->host == "localhost") address->host = "127.0.0.1";
  if (address->host == "*") return *address;
  const auto numbers = numbers_of(address->host);
  if (numbers && !numbers->empty()) address->host = numbers->front();
  if (!numbers && is_host_number(address->host))
    return bad_input(numbers.error().message, endpoint);
  return *address;
}

std::string property_of(zmq::message_t& frame, const char* name) {
  const char* value = zmq_msg_gets(frame.handle(), name);
  return value != nullptr ? value : "";
}

}  // namespace

std::uint64_t Refusals::total() const {
  std::uint64_t sum = 0;
  for (const auto& [reason, count] : counts)
    sum += count;
  return sum;
}

std::optional<Address> address_of(std::string_view endpoint) {
  if (!endpoint.starts_with(kTcpScheme)) return std::nullopt;
  auto address = parse_address(endpoint.substr(kTcpScheme.size()));
  return address ? std::optional(std::move(*address)) : std::nullopt;
}

std::string tcp_endpoint(const Address& address) {
  return std::string(kTcpScheme) + to_string(address);
}

struct ServerSocket::Impl {
  /// What is known of a peer since its first message. Measured: asking libzmq for the user id of a
  /// message takes 18 ns, finding the peer here 14 ns; but this needs no lock and no look-up by key
  /// for each message, and lets a revocation find the peers to disconnect.
  struct Peer {
    std::string key;
    std::optional<ListedClient> client;  ///< empty once it is disconnected
    std::string address;
    bool stranger = false;  ///< it belongs to another user
    Connection connection;
    Gate::Taken taken;
    std::uint64_t* unsent_to_host = nullptr;
    std::uint64_t given = 0;       ///< bytes of frames that were sent to it
    std::uint64_t arrived = 0;     ///< how many of them had arrived at the last check
    std::uint64_t long_frame = 0;  ///< size of a long frame that is on its way
    TimePoint slow_after;          ///< when that frame counts as too slow

    std::uint64_t unsent() const { return given - arrived; }
  };

  zmq::context_t context{1};
  zmq::socket_t socket{context, zmq::socket_type::router};
  std::unique_ptr<Gate> gate;
  bool by_key = false;
  bool asks_for_user = false;
  SocketOptions options;
  SystemClock clock;
  std::unordered_map<PeerId, Peer> peers;
  std::unordered_map<std::string, std::uint64_t> unsent_to;  ///< by network
  std::uint64_t unsent_to_all = 0;
  std::vector<PeerId> gone;  ///< their last messages may still have to be read
  TimePoint looked;          ///< when all peers were checked last
  std::string endpoint;
  zmq::message_t name;
  zmq::message_t frame;

  /// The peer of a message whose first part is `frame`.
  Peer& peer_behind(PeerId id) {
    const auto known = peers.find(id);
    if (known != peers.end()) return known->second;
    if (peers.size() >= kMostPeers) {
      peers.clear();
      unsent_to.clear();
      unsent_to_all = 0;
    }
    Peer& peer = peers[id];
    peer.address = plain_number(property_of(frame, "Peer-Address"));
    peer.connection = connection_at(zmq_msg_get(frame.handle(), ZMQ_SRCFD));
    peer.taken = gate->meter_of(peer.connection);
    peer.unsent_to_host = &unsent_to[network_of(peer.address)];
    if (asks_for_user && !is_of_same_user(id, peer)) {
      peer.stranger = true;
      cut(peer.connection);
    }
    if (!by_key) return peer;
    peer.key = property_of(frame, "User-Id");
    check(peer);
    return peer;
  }

  /// The kernel knows the user of a connection, and libzmq knows whether the connection still
  /// exists. If it does, the descriptor in the message cannot belong to another connection by now,
  /// since libzmq learns of an end before it closes the descriptor.
  bool is_of_same_user(PeerId id, const Peer& peer) {
    if (!swarmsmith::is_of_same_user(peer.connection.descriptor)) return false;
    if (!options.probes_newcomers) return true;
    (void)socket.get(zmq::sockopt::events);  // processes pending events, which sending may postpone
    const RoutingId to = routing_id_of(id);
    const std::string_view bytes(reinterpret_cast<const char*>(to.data()), to.size());
    return send_on(socket, bytes, zmq::send_flags::sndmore) == SendStatus::Sent &&
           send_on(socket, "", zmq::send_flags::none) == SendStatus::Sent;
  }

  void change_unsent(Peer& peer, std::uint64_t given, std::uint64_t arrived) {
    const std::uint64_t change = given - arrived - peer.unsent();
    *peer.unsent_to_host += change;
    unsent_to_all += change;
    peer.given = given;
    peer.arrived = arrived;
    if (peer.unsent() <= kLittle) peer.long_frame = 0;
  }

  /// Asks the system how much of the sent data has arrived. libzmq sends more than the frames, so
  /// more bytes may have arrived than frames have.
  void look_at(Peer& peer) {
    const std::optional<TcpBytes> bytes = tcp_bytes_of(peer.connection);
    const std::uint64_t arrived = bytes ? bytes->acknowledged : peer.given;
    change_unsent(peer, std::max(peer.given, arrived), arrived);
  }

  void look_at_all() {
    const TimePoint now = clock.now();
    if (now - looked < kLookAgain) return;
    looked = now;
    for (auto& [id, peer] : peers) {
      if (peer.unsent() > 0) look_at(peer);
      if (peer.long_frame > 0 && now > peer.slow_after) drop(peer);
    }
  }

  void drop(Peer& peer) {
    gate->count_refusal("reads too slowly", peer.address);
    cut(peer.connection);
    change_unsent(peer, peer.given, peer.given);
  }

  /// Whether this many bytes may be sent to the peer now.
  SendStatus room_for(Peer& peer, std::size_t size) {
    if (peer.unsent() + size > kLittle) look_at(peer);
    const bool is_long = size > kLongFrame;
    // `most_unsent` is in addition to one long frame.
    if (is_long && peer.long_frame > 0) return SendStatus::Later;
    if (!is_long && peer.unsent() + size > options.most_unsent + peer.long_frame) {
      drop(peer);
      return SendStatus::Full;
    }
    const auto fits = [&] {
      // If nothing else is on its way, even the longest frame may be sent.
      return unsent_to_all <= kLittle ||
             (unsent_to_all + size <= options.most_unsent_to_all &&
              *peer.unsent_to_host + size <= options.most_unsent_to_host);
    };
    // A peer that receives at once is served even while others exhaust the common limits.
    if (fits() || (!is_long && peer.unsent() + size <= kLittle)) return SendStatus::Sent;
    look_at_all();
    if (fits()) return SendStatus::Sent;
    if (is_long) return SendStatus::Later;
    drop(peer);
    return SendStatus::Full;
  }

  void count_sent(Peer& peer, std::size_t size) {
    if (size > kLongFrame) {
      const std::chrono::duration<double> time(static_cast<double>(size) / kLeastBytesPerSecond);
      peer.slow_after = clock.now() + kPatience + std::chrono::duration_cast<Duration>(time);
      peer.long_frame = size;
    }
    change_unsent(peer, peer.given + size, peer.arrived);
  }

  /// Looks up the peer in the current list; false when it has been disconnected.
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
  const auto address = address_to_bind(endpoint);
  if (!address) return Unexpected(address.error());
  auto impl = std::make_unique<Impl>();
  apply(options, kMaxFrameBytes, impl->socket);
  // "*" then means every interface of both families.
  const bool both = address->host == "*";
  impl->socket.set(zmq::sockopt::ipv6, both || address->host.find(':') != std::string::npos);
  impl->socket.set(zmq::sockopt::backlog, kBacklog);
  // Otherwise a message to a peer that has gone would be lost without an error.
  impl->socket.set(zmq::sockopt::router_mandatory, true);
  impl->by_key = keys.has_value();
  impl->options = options;
  impl->asks_for_user = !keys && is_loopback(address->host) && kernel_names_users();
  impl->gate =
      std::make_unique<Gate>(impl->context, impl->socket,
                             Gate::Asks{.key = impl->by_key, .user = impl->asks_for_user}, options);
  if (keys) {
    impl->gate->admit(std::move(keys->clients));
    impl->socket.set(zmq::sockopt::curve_server, true);
    impl->socket.set(zmq::sockopt::curve_secretkey, keys->secret_key);
    impl->socket.set(zmq::sockopt::zap_domain, "swarmsmith");
  }
  try {
    impl->socket.bind(tcp_endpoint(*address));
  } catch (const zmq::error_t& error) {
    const bool taken = error.num() == EADDRINUSE;
    return unexpected(
        taken ? ErrorKind::Conflict : ErrorKind::Unavailable,
        taken ? "another program listens on this port; name another port, or end that program"
              : std::string("cannot listen on this address: ") + error.what(),
        endpoint);
  }
  impl->endpoint = impl->socket.get(zmq::sockopt::last_endpoint);
  return std::unique_ptr<ServerSocket>(new ServerSocket(std::move(impl)));
}

const std::string& ServerSocket::endpoint() const {
  return impl_->endpoint;
}

bool ServerSocket::asks_for_user() const {
  return impl_->asks_for_user;
}

SendStatus ServerSocket::send(PeerId peer, std::string_view frame) {
  const auto known = impl_->peers.find(peer);
  const bool is_known = known != impl_->peers.end();
  if (is_known) {
    if (known->second.stranger || (impl_->by_key && !known->second.client)) return SendStatus::Gone;
    const SendStatus room = impl_->room_for(known->second, frame.size());
    if (room != SendStatus::Sent) return room;
  }
  const RoutingId name = routing_id_of(peer);
  const std::string_view bytes(reinterpret_cast<const char*>(name.data()), name.size());
  SendStatus status = send_on(impl_->socket, bytes, zmq::send_flags::sndmore);
  if (status == SendStatus::Sent) status = send_on(impl_->socket, frame, zmq::send_flags::none);
  if (!is_known) return status;
  if (status == SendStatus::Sent) {
    impl_->count_sent(known->second, frame.size());
  } else if (status == SendStatus::Full) {
    impl_->drop(known->second);
  } else {
    impl_->change_unsent(known->second, 0, 0);
    impl_->gone.push_back(peer);
  }
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
      if (frames++ == 0 && id) peer = &impl_->peer_behind(*id);
      if (peer == nullptr || peer->taken == nullptr) continue;
      *peer->taken += impl_->frame.size() + (impl_->by_key ? kBesidesAFrameByKey : kBesidesAFrame);
    }
    if (frames != 1) impl_->frame.rebuild();
    if (peer == nullptr || peer->stranger || (impl_->by_key && !peer->client)) continue;
    received = {.peer = *id,
                .frame = impl_->frame.to_string_view(),
                .role = {},
                .client = {},
                .address = peer->address};
    if (impl_->by_key) {
      received.role = peer->client->role;
      received.client = peer->client->name;
    }
    return true;
  }
  for (const PeerId peer : std::exchange(impl_->gone, {}))
    impl_->peers.erase(peer);
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
