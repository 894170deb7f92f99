#include "proto/internal/gate.h"

#include <sys/socket.h>
#include <algorithm>
#include <array>
#include <utility>

namespace swarmsmith {
namespace {

/// Where libzmq asks; fixed by the ZAP specification.
constexpr const char* kHandler = "inproc://zeromq.zap.01";
constexpr std::string_view kVersion = "1.0";
constexpr std::size_t kKeyBytes = 32;
constexpr std::size_t kKeyCharacters = 40;
constexpr int kEvents = ZMQ_EVENT_ACCEPTED | ZMQ_EVENT_HANDSHAKE_SUCCEEDED |
                        ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL | ZMQ_EVENT_DISCONNECTED;
/// What libzmq may need to end a handshake that took too long.
constexpr Duration kSlack = std::chrono::milliseconds(500);
constexpr std::chrono::milliseconds kLookAgain{250};

constexpr const char* kSilent = "no handshake";
/// Reasons that end connections which had come in.
constexpr const char* kRevoked = "revoked key";

/// Parts of a request, in their order.
enum Part : std::size_t { Version, RequestId, Domain, Address, Identity, Mechanism, Credentials };
constexpr std::size_t kParts = 7;

std::string z85_of(const std::string& bytes) {
  std::array<char, kKeyCharacters + 1> text{};
  zmq_z85_encode(text.data(), reinterpret_cast<const std::uint8_t*>(bytes.data()), kKeyBytes);
  return text.data();
}

/// What a failed handshake most likely was.
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

}  // namespace

Gate::Gate(zmq::context_t& context, zmq::socket_t& server, bool admit_by_key,
           const SocketOptions& options)
    : server_(&server),
      max_connections_(static_cast<std::size_t>(options.max_connections)),
      young_for_(options.handshake_timeout + kSlack) {
  if (admit_by_key) {
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
    poll(items.data(), count, handshakes_.empty() ? std::chrono::milliseconds{-1} : kLookAgain);
    if (items[0].revents != 0) break;
    const TimePoint now = clock.now();
    if (items[1].revents != 0) hear_event(now);
    grow_old(now);
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

/// Request and reply as ZAP has them. The user id that goes with each message of the connection is
/// the client's public key: what it may do is looked up when it speaks, so that a list that changed
/// meanwhile counts.
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
  if (!objection.empty()) count_refusal(objection, complete ? parts[Address] : "");
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
        ++accepted_;
        if (open_.size() >= max_connections_) {
          count_refusal("too many connections", "");
          shutdown(event.value, SHUT_RDWR);
        }
        open_[event.value] = {.since = now};
        handshakes_.emplace_back(now, event.value);
        ++young_;
        break;
      case ZMQ_EVENT_HANDSHAKE_SUCCEEDED:
        ++succeeded_;
        break;
      case ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL:
        count_refusal(reason_of_protocol_error(event.value), "");
        break;
      default: {
        const auto at = open_.find(event.value);
        if (at == open_.end()) break;
        if (at->second.young) --young_;
        open_.erase(at);
      }
    }
  }
  count_silent();
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

/// libzmq does not say which connection's handshake succeeded, nor that one ended by rubbish. But
/// each that was accepted has succeeded, has failed, or is young: so at least accepted - succeeded
/// - young have failed, and those without another reason sent rubbish, or nothing.
void Gate::count_silent() {
  const std::scoped_lock lock(mutex_);
  std::int64_t failed = accepted_ - succeeded_ - young_;
  for (const auto& [reason, count] : refusals_.counts) {
    if (reason != kSilent && reason != kRevoked) failed -= static_cast<std::int64_t>(count);
  }
  if (failed <= 0) return;
  std::uint64_t& known = refusals_.counts[kSilent];
  known = std::max(known, static_cast<std::uint64_t>(failed));
}

}  // namespace swarmsmith
