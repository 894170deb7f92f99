// Hostile peers in one process, over real sockets.
//
//   hostile ADDRESS SEED MESSAGES CONNECTIONS RATE MISDEEDS [KEY_FILE]
//
// Says MESSAGES in all, RATE a second at most, over CONNECTIONS at most, which come evenly in that
// time; ten are open at a time. Peers that hang up early say less. MISDEEDS are names with commas
// between them, as tests/support/hostile_peer.h has them; the connections take them in turn. With a
// key file it is who the key says. Ends when all is said, when the connections are used up, or when
// no peer lets it in any more; prints a line of JSON: what it did.

#include <charconv>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "proto/access/key_file.h"
#include "proto/socket.h"
#include "sim/engine/self_test.h"
#include "sim/engine/simulate.h"
#include "tests/support/hostile_peer.h"
#include "worker/protocol.h"
#include "worker/slots.h"

namespace swarmsmith {
namespace {

using cluster::HostilePeer;
using cluster::Misdeed;
using std::chrono::milliseconds;

constexpr std::size_t kOpen = 10;
/// Connections in a row that were not welcome: no peer lets it in any more.
constexpr int kTurnedAway = 300;

struct Job {
  std::string endpoint;
  std::uint64_t seed = 1;
  std::uint64_t messages = 0;
  std::uint64_t connections = 0;
  std::uint64_t rate = 0;
  std::vector<Misdeed> misdeeds;
  std::optional<ClientKeys> keys;
};

/// How an honest worker of this build introduces itself.
std::string honest_hello() {
  WorkerIdentity identity = identity_of_this_process(1, "hostile");
  identity.engine_version = kEngineVersion;
  identity.self_test = self_test_digest();
  WorkerProtocol protocol(identity, {}, Rng(1));
  protocol.start({});
  for (const WorkerAction& action : protocol.take_actions()) {
    if (const auto* send = std::get_if<SendToCoordinator>(&action)) return send->frame;
  }
  return {};
}

/// One connection after the other.
class Visitor {
 public:
  Visitor(const Job& job, Misdeed misdeed, std::uint64_t number, const std::string& hello)
      : socket_("tcp://" + job.endpoint, {}, job.keys),
        peer_(misdeed, Rng(job.seed).split("visitor", number)),
        most_(std::max<std::uint64_t>(job.messages / job.connections, 1)) {
    peer_.overhear(hello);
  }

  /// A step; the messages that it said.
  std::uint64_t step() {
    if (!connected_) return 0;
    std::string frame;
    while (socket_.receive(frame)) {
      heard_ = true;
      peer_.on_frame(frame);
    }
    peer_.on_tick();
    const std::uint64_t said = flush();
    said_ += said;
    if (peer_.take_hang_up() || said_ >= most_ || socket_.lost()) leave();
    return said;
  }

  void come() {
    socket_.connect();
    connected_ = true;
    heard_ = false;
    said_ = 0;
    peer_.on_connected();
    flush();
  }

  bool connected() const { return connected_; }
  /// Whether anything was heard on the last connection.
  bool heard() const { return heard_; }
  const HostilePeer& peer() const { return peer_; }

 private:
  std::uint64_t flush() {
    std::uint64_t said = 0;
    for (const std::string& frame : peer_.take_frames())
      said += socket_.send(frame) == SendStatus::Sent ? 1U : 0U;
    return said;
  }

  void leave() {
    socket_.close(milliseconds{20});
    connected_ = false;
  }

  ClientSocket socket_;
  HostilePeer peer_;
  std::uint64_t most_;
  std::uint64_t said_ = 0;
  bool connected_ = false;
  bool heard_ = false;
};

struct Totals {
  std::uint64_t messages = 0;
  std::uint64_t connections = 0;
};

Totals talk(const Job& job, std::vector<std::unique_ptr<Visitor>>& visitors) {
  const SystemClock clock;
  const TimePoint begun = clock.now();
  Totals totals;
  int turned_away = 0;
  const double whole_s = static_cast<double>(job.messages) / static_cast<double>(job.rate);
  bool more = true;
  while (totals.messages < job.messages && turned_away < kTurnedAway && more) {
    const double share = std::chrono::duration<double>(clock.now() - begun).count() / whole_s;
    const auto due =
        std::min(job.connections,
                 kOpen + static_cast<std::uint64_t>(share * static_cast<double>(job.connections)));
    more = totals.connections < job.connections;
    for (const auto& visitor : visitors) {
      if (!visitor->connected()) {
        if (totals.connections >= due) continue;
        if (totals.connections > 0) turned_away = visitor->heard() ? 0 : turned_away + 1;
        visitor->come();
        ++totals.connections;
      }
      totals.messages += visitor->step();
      more = more || visitor->connected();
    }
    const auto said = std::chrono::microseconds(totals.messages * 1'000'000 / job.rate);
    const Duration early = said - (clock.now() - begun);
    std::this_thread::sleep_for(std::max<Duration>(early, milliseconds(1)));
  }
  return totals;
}

int run(const Job& job) {
  const std::string hello = honest_hello();
  std::vector<std::unique_ptr<Visitor>> visitors;
  for (std::size_t i = 0; i < kOpen; ++i)
    visitors.push_back(
        std::make_unique<Visitor>(job, job.misdeeds[i % job.misdeeds.size()], i, hello));
  const Totals totals = talk(job, visitors);
  std::map<std::string, std::uint64_t> acts;
  for (const auto& visitor : visitors)
    acts[name_of(visitor->peer().misdeed())] += visitor->peer().acts();
  std::printf("{\"messages\":%llu,\"connections\":%llu,\"acts\":{",
              static_cast<unsigned long long>(totals.messages),
              static_cast<unsigned long long>(totals.connections));
  const char* comma = "";
  for (const auto& [name, times] : acts) {
    std::printf("%s\"%s\":%llu", comma, name.c_str(), static_cast<unsigned long long>(times));
    comma = ",";
  }
  std::printf("}}\n");
  return 0;
}

std::optional<std::uint64_t> number(std::string_view text) {
  std::uint64_t value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size() || value == 0) return std::nullopt;
  return value;
}

std::vector<Misdeed> misdeeds_of(std::string_view text) {
  std::vector<Misdeed> found;
  while (!text.empty()) {
    const std::string_view name = text.substr(0, text.find(','));
    text.remove_prefix(std::min(name.size() + 1, text.size()));
    for (const Misdeed misdeed : cluster::kMisdeeds) {
      if (name == name_of(misdeed)) found.push_back(misdeed);
    }
  }
  return found;
}

}  // namespace
}  // namespace swarmsmith

int main(int argc, char** argv) {
  using namespace swarmsmith;
  if (argc != 7 && argc != 8) return 2;
  Job job{.endpoint = argv[1], .misdeeds = misdeeds_of(argv[6]), .keys = {}};
  const auto seed = number(argv[2]);
  const auto messages = number(argv[3]);
  const auto connections = number(argv[4]);
  const auto rate = number(argv[5]);
  if (!seed || !messages || !connections || !rate || job.misdeeds.empty()) return 2;
  job.seed = *seed;
  job.messages = *messages;
  job.connections = *connections;
  job.rate = *rate;
  if (argc == 8) {
    const auto key = read_client_key(argv[7]);
    if (!key) {
      std::fprintf(stderr, "hostile: %s\n", to_string(key.error()).c_str());
      return 2;
    }
    job.keys = key->keys();
  }
  return run(job);
}
