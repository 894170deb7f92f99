#include "coordinator/service/front_door.h"

#include <string_view>
#include <utility>

#include "base/log.h"
#include "proto/access/address.h"

namespace swarmsmith {
namespace {

/// A storm of strangers makes a line a reason in this time.
constexpr Duration kSayAgain = std::chrono::seconds(10);

}  // namespace

Expected<std::unique_ptr<ServerSocket>> open_front_door(ServiceOptions& options) {
  const bool insisted = options.insecure_plaintext;
  if (options.bind.empty()) options.bind = "tcp://127.0.0.1:*";
  // A name of an interface is what a socket would look for.
  if (constexpr std::string_view kName = "tcp://localhost:"; options.bind.starts_with(kName)) {
    options.bind.replace(0, kName.size(), "tcp://127.0.0.1:");
  }
  const auto address = address_of(options.bind);
  if (!address) {
    return bad_input("invalid address; expected host and port, such as 127.0.0.1:5555",
                     options.bind);
  }
  options.insecure_plaintext = !options.keys && !is_loopback(*address);
  if (options.insecure_plaintext && !insisted) {
    return bad_input(
        "other hosts may connect here, so keys are needed: make them with `swarmsmith "
        "keygen`, or listen on tcp://127.0.0.1:PORT",
        options.bind);
  }
  if (options.insecure_plaintext) {
    log_event(
        LogLevel::Warning, "coordinator",
        "listening beyond loopback without encryption: anybody who reaches the port can read the "
        "campaign, send results and give commands",
        {{"address", options.bind}});
  }
  // The last words of a campaign send its workers home.
  options.socket.linger = std::chrono::milliseconds{200};
  return ServerSocket::bind(options.bind, options.socket, std::move(options.keys));
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
