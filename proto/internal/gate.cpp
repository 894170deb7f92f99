#include "proto/internal/gate.h"

#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <fstream>
#include <functional>
#include <unordered_set>
#include <utility>

#include "base/peer_user.h"
#include "proto/network.h"

namespace swarmsmith {
namespace {

/// Where libzmq sends its questions; fixed by the ZAP specification.
constexpr const char* kHandler = "inproc://zeromq.zap.01";
constexpr std::string_view kVersion = "1.0";
constexpr std::size_t kKeyBytes = 32;
constexpr std::size_t kKeyCharacters = 40;
constexpr int kEvents = ZMQ_EVENT_ACCEPTED | ZMQ_EVENT_HANDSHAKE_SUCCEEDED |
                        ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL | ZMQ_EVENT_DISCONNECTED;
/// Extra time that libzmq may need to end a handshake that took too long.
constexpr Duration kSlack = std::chrono::milliseconds(500);
/// Time between two checks of memory: a peer of this host can send some ten megabytes meanwhile.
constexpr std::chrono::milliseconds kLookAgain{10};
/// Connections are weighed when memory has grown by this much, and otherwise at longer intervals:
/// for a cluster this takes thousands of system calls.
constexpr std::size_t kGrowth = 8U << 20U;
constexpr Duration kWeighAgain = std::chrono::seconds(1);
/// At most this many bytes wait in total when nothing is wrong.
constexpr std::uint64_t kNextToNothing = 256U << 10U;
/// A connection with fewer bytes waiting is not closed because of the process's memory.
constexpr std::uint64_t kLittle = 64U << 10U;

constexpr const char* kSilent = "no handshake";
/// Reasons for closing connections that had been admitted.
constexpr const char* kRevoked = "revoked key";
constexpr const char* kTooMuch = "too much at once";
constexpr const char* kTooSlow = "reads too slowly";

/// Parts of a request, in this order.
enum Part : std::size_t { Version, RequestId, Domain, From, Identity, Mechanism, Credentials };
constexpr std::size_t kParts = 7;

std::string z85_of(const std::string& bytes) {
  std::array<char, kKeyCharacters + 1> text{};
  zmq_z85_encode(text.data(), reinterpret_cast<const std::uint8_t*>(bytes.data()), kKeyBytes);
  return text.data();
}

/// The most likely reason of a failed handshake.
std::string reason_of_protocol_error(int error) {
  switch (error) {
    case ZMQ_PROTOCOL_ERROR_ZMTP_MECHANISM_MISMATCH:
      return "plaintext";
    case ZMQ_PROTOCOL_ERROR_ZMTP_CRYPTOGRAPHIC:
      return "wrong server key";
    default:
      return "bad handshake";
  }
}

/// The numeric address of a peer; empty when the connection is gone.
std::string address_of(int descriptor) {
  sockaddr_storage peer = {};
  socklen_t size = sizeof peer;
  std::array<char, NI_MAXHOST> text{};
  auto* const address = reinterpret_cast<sockaddr*>(&peer);
  if (getpeername(descriptor, address, &size) != 0 ||
      getnameinfo(address, size, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST) != 0) {
    return {};
  }
  return plain_number(text.data());
}

/// Bytes of memory that this process uses.
std::size_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::size_t pages = 0;
  std::size_t resident = 0;
  file >> pages >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace

Gate::Gate(zmq::context_t& context, zmq::socket_t& server, Asks asks, const SocketOptions& options)
    : server_(&server),
      asks_(asks),
      options_(options),
      young_for_(options.handshake_timeout + kSlack) {
  if (asks.key) {
    requests_ = zmq::socket_t(context, zmq::socket_type::rep);
    requests_.set(zmq::sockopt::linger, 0);
    requests_.bind(kHandler);
  }
  monitor_ = watch(context, server, "gate", kEvents);
  thread_ = std::thread([this] { work(); });
}

Gate::~Gate() {
  stop_watching(*server_);
  stop_.notify();
  thread_.join();
}

void Gate::admit(std::vector<ListedClient> clients) {
  std::unordered_map<std::string, ListedClient> by_key;
  for (ListedClient& client : clients) {
    std::string key = client.public_key;
    by_key.emplace(std::move(key), std::move(client));
  }
  const std::scoped_lock lock(mutex_);
  clients_ = std::move(by_key);
}

std::optional<ListedClient> Gate::find(const std::string& public_key) const {
  const std::scoped_lock lock(mutex_);
  const auto at = clients_.find(public_key);
  if (at == clients_.end() || at->second.expired) return std::nullopt;
  return at->second;
}

void Gate::count_refusal(const std::string& reason, const std::string& from) {
  const std::scoped_lock lock(mutex_);
  ++refusals_.counts[reason];
  if (!from.empty()) refusals_.last_from[reason] = from;
}

Refusals Gate::refusals() const {
  const std::scoped_lock lock(mutex_);
  return refusals_;
}

void Gate::work() {
  std::array<zmq_pollitem_t, 3> items{{{nullptr, stop_.file_descriptor(), ZMQ_POLLIN, 0},
                                       {monitor_.handle(), 0, ZMQ_POLLIN, 0},
                                       {requests_.handle(), 0, ZMQ_POLLIN, 0}}};
  const std::size_t count = requests_.handle() != nullptr ? 3 : 2;
  const SystemClock clock;
  while (true) {
    poll(items.data(), count,
         open_.empty() && handshakes_.empty() ? std::chrono::milliseconds{-1} : kLookAgain);
    if (items[0].revents != 0) break;
    const TimePoint now = clock.now();
    if (items[1].revents != 0) hear_event(now);
    grow_old(now);
    weigh(now);
    if (count == 3 && items[2].revents != 0) answer_request();
  }
  // A socket belongs to the thread that uses it.
  requests_.close();
  monitor_.close();
}

std::string Gate::objection_to(const std::string& public_key) const {
  const std::scoped_lock lock(mutex_);
  const auto at = clients_.find(public_key);
  if (at == clients_.end()) return "unlisted key";
  return at->second.expired ? "expired key" : "";
}

/// Request and reply follow ZAP. The user id in each message of the connection is the client's
/// public key. Its permissions are looked up with each message, so that changes of the list take
/// effect.
void Gate::answer_request() {
  std::vector<std::string> parts;
  zmq::message_t message;
  do {
    if (!requests_.recv(message, zmq::recv_flags::dontwait)) return;
    parts.push_back(message.to_string());
  } while (message.more());
  const bool complete = parts.size() == kParts && parts[Version] == kVersion &&
                        parts[Mechanism] == "CURVE" && parts[Credentials].size() == kKeyBytes;
  const std::string key = complete ? z85_of(parts[Credentials]) : "";
  const std::string objection = complete ? objection_to(key) : "bad handshake";
  if (!objection.empty()) count_refusal(objection, complete ? plain_number(parts[From]) : "");
  const std::array<std::string, 6> reply = {std::string(kVersion),
                                            parts.size() > RequestId ? parts[RequestId] : "",
                                            objection.empty() ? "200" : "400",
                                            objection.empty() ? "OK" : "No access",
                                            objection.empty() ? key : "",
                                            ""};
  for (std::size_t i = 0; i < reply.size(); ++i) {
    const bool last = i + 1 == reply.size();
    requests_.send(zmq::buffer(reply[i]), last ? zmq::send_flags::none : zmq::send_flags::sndmore);
  }
}

void Gate::hear_event(TimePoint now) {
  MonitorEvent event;
  while (receive_event(monitor_, event)) {
    switch (event.event) {
      case ZMQ_EVENT_ACCEPTED:
        let_in(event.value, now);
        break;
      case ZMQ_EVENT_HANDSHAKE_SUCCEEDED:
        ++succeeded_;
        break;
      case ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL:
        count_refusal(reason_of_protocol_error(event.value), "");
        break;
      default:
        forget(event.value);
    }
  }
  count_silent();
}

void Gate::let_in(int descriptor, TimePoint now) {
  ++accepted_;
  // An earlier connection with this descriptor, whose end was not reported.
  forget(descriptor);
  std::string address = address_of(descriptor);
  const std::string network = network_of(address);
  const char* refusal = nullptr;
  if (open_.size() >= static_cast<std::size_t>(options_.max_connections)) {
    refusal = "too many connections";
  } else if (open_of_[network] >= options_.max_connections_of_host) {
    refusal = "too many connections of one host";
  } else if (asks_.user) {
    const auto user = user_of_peer(descriptor);
    // A peer that has already gone (and has no user) sends nothing more.
    if (user && !is_same_user(*user)) {
      refusal = "another user";
      address = "user " + name_of_user(*user);
    }
  }
  if (refusal != nullptr) {
    count_refusal(refusal, address);
    shutdown(descriptor, SHUT_RDWR);
  }
  open_[descriptor] = {.since = now,
                       .connection = connection_at(descriptor),
                       .network = network,
                       .cut = refusal != nullptr};
  ++open_of_[network];
  handshakes_.emplace_back(now, descriptor);
  ++young_;
}

void Gate::forget(int descriptor) {
  const auto at = open_.find(descriptor);
  if (at == open_.end()) return;
  if (at->second.young) --young_;
  const auto of_host = open_of_.find(at->second.network);
  if (--of_host->second == 0) open_of_.erase(of_host);
  const std::scoped_lock lock(mutex_);
  meters_.erase(at->second.connection.inode);
  open_.erase(at);
}

Gate::Taken Gate::meter_of(const Connection& connection) {
  if (connection.descriptor < 0) return nullptr;
  const std::scoped_lock lock(mutex_);
  Taken& taken = meters_[connection.inode];
  if (taken == nullptr) taken = std::make_shared<std::atomic<std::uint64_t>>(0);
  return taken;
}

/// Of connections that ended before the gate saw them open, so that `forget` could not find them.
void Gate::drop_lost_meters() {
  std::unordered_set<ino_t> open;
  for (const auto& [descriptor, connection] : open_)
    open.insert(connection.connection.inode);
  const std::scoped_lock lock(mutex_);
  std::erase_if(meters_, [&](const auto& meter) {
    return meter.second.use_count() == 1 && !open.contains(meter.first);
  });
}

void Gate::weigh(TimePoint now) {
  const std::size_t resident = resident_bytes();
  if (resident < resident_ + kGrowth && now - weighed_ < kWeighAgain) return;
  weigh_all(resident);
  resident_ = resident;
  weighed_ = now;
}

/// Data that was received and not taken is in libzmq's queues, which have no limits of their own. A
/// message of two bytes takes 64 bytes there, so there is one limit for the waiting bytes, and one
/// for memory.
void Gate::weigh_all(std::size_t resident) {
  drop_lost_meters();
  std::vector<std::pair<std::uint64_t, Open*>> waiting;
  std::unordered_map<std::string, std::uint64_t> of_host;
  std::uint64_t of_all = 0;
  for (auto& [descriptor, open] : open_) {
    const std::optional<TcpBytes> bytes = open.cut ? std::nullopt : tcp_bytes_of(open.connection);
    if (!bytes) continue;
    const Taken meter = meter_of(open.connection);
    std::uint64_t taken = meter->load();
    // The overhead of frames is only estimated.
    if (taken > bytes->received) meter->compare_exchange_strong(taken, bytes->received);
    if (taken >= bytes->received) continue;
    const std::uint64_t held = bytes->received - taken;
    waiting.emplace_back(held, &open);
    of_host[open.network] += held;
    of_all += held;
  }
  if (of_all <= kNextToNothing || calm_ == 0) calm_ = resident;
  const bool takes_too_much = resident > calm_ + options_.most_waiting_memory;
  // Growth counts from here again, since the process may keep memory that was freed.
  if (takes_too_much) calm_ = resident;
  const std::uint64_t half = of_all / 2;
  // The connections with the most waiting bytes are closed first.
  std::ranges::sort(waiting, std::greater<>(), &std::pair<std::uint64_t, Open*>::first);
  for (const auto& [held, open] : waiting) {
    std::uint64_t& host = of_host[open->network];
    const bool fits = held <= options_.most_waiting && host <= options_.most_waiting_of_host &&
                      of_all <= options_.most_waiting_of_all;
    if (fits && !(takes_too_much && of_all > half && held > kLittle)) continue;
    count_refusal(kTooMuch, address_of(open->connection.descriptor));
    cut(open->connection);
    open->cut = true;
    host -= held;
    of_all -= held;
  }
}

void Gate::grow_old(TimePoint now) {
  if (handshakes_.empty() || now - handshakes_.front().first <= young_for_) return;
  while (!handshakes_.empty() && now - handshakes_.front().first > young_for_) {
    const auto [since, descriptor] = handshakes_.front();
    const auto at = open_.find(descriptor);
    if (at != open_.end() && at->second.since == since) {
      at->second.young = false;
      --young_;
    }
    handshakes_.pop_front();
  }
  count_silent();
}

/// libzmq does not report which connection's handshake succeeded, nor that one ended because of
/// invalid data. But each accepted connection has succeeded, has failed, or is young. So at least
/// accepted - succeeded - young have failed, and those without another reason sent invalid data, or
/// nothing.
void Gate::count_silent() {
  const std::scoped_lock lock(mutex_);
  std::int64_t failed = accepted_ - succeeded_ - young_;
  for (const auto& [reason, count] : refusals_.counts) {
    const bool had_come_in = reason == kRevoked || reason == kTooMuch || reason == kTooSlow;
    if (reason != kSilent && !had_come_in) failed -= static_cast<std::int64_t>(count);
  }
  if (failed <= 0) return;
  std::uint64_t& known = refusals_.counts[kSilent];
  known = std::max(known, static_cast<std::uint64_t>(failed));
}

}  // namespace swarmsmith
