#include "coordinator/service/front_door.h"

#include <utility>

#include "base/log.h"
#include "proto/access/address.h"

namespace swarmsmith {
namespace {

/// At most one log line for each reason in this time, however many strangers connect.
constexpr Duration kSayAgain = std::chrono::seconds(10);

}  // namespace

Expected<std::unique_ptr<ServerSocket>> open_front_door(ServiceOptions& options) {
  const bool insisted = options.insecure_plaintext;
  if (options.bind.empty()) options.bind = "tcp://127.0.0.1:*";
  const auto endpoint = endpoint_of(options.bind, false);
  if (!endpoint) return Unexpected(endpoint.error());
  options.bind = *endpoint;
  options.insecure_plaintext = !options.keys && !is_loopback(address_of(options.bind)->host);
  if (options.insecure_plaintext && !insisted) {
    return bad_input(
        "other hosts may connect here, so keys are needed: make them with `swarmsmith "
        "keygen`, or listen on tcp://127.0.0.1:PORT",
        options.bind);
  }
  if (options.insecure_plaintext) {
    log_event(
        LogLevel::Warning, "coordinator",
        "listening beyond loopback without encryption: any host that reaches the port can read the "
        "campaign, send results and give commands",
        {{"address", options.bind}});
  }
  // Leaves time to send the final messages of a campaign, which tell its workers to end.
  options.socket.linger = std::chrono::milliseconds{200};
  const bool has_keys = options.keys.has_value();
  auto socket = ServerSocket::bind(options.bind, options.socket, std::move(options.keys));
  if (socket && !has_keys && !options.insecure_plaintext && !(*socket)->asks_for_user()) {
    log_event(LogLevel::Warning, "coordinator",
              "this system does not tell which user opens a connection: other users of this host "
              "can send "
              "results and give commands; `swarmsmith keygen` makes keys",
              {{"address", options.bind}});
  }
  return socket;
}

void RefusalLog::say(const Refusals& refusals, TimePoint now) {
  for (const auto& [reason, count] : refusals.counts) {
    Said& said = said_[reason];
    if (count == said.count || (said.count > 0 && now - said.when < kSayAgain)) continue;
    const auto from = refusals.last_from.find(reason);
    log_event(LogLevel::Warning, "coordinator", "connection refused",
              {{"reason", reason},
               {"times", std::to_string(count - said.count)},
               {"last_from", from != refusals.last_from.end() ? from->second : "unknown"}});
    said = {count, now};
  }
}

}  // namespace swarmsmith
