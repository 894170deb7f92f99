#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "base/address.h"
#include "base/expected.h"
#include "coordinator/service/http_site.h"
#include "coordinator/service/live_status.h"

namespace swarmsmith {

struct HttpOptions {
  Address address;         ///< where pages are served
  bool next_port = false;  ///< when another program listens there, one of the next hundred will do
  std::string token;       ///< that requests must carry; must not be empty beyond loopback
  /// What the Host header may name besides: this server's name at a proxy.
  std::vector<std::string> names{};
  std::shared_ptr<HttpSite> site{};  ///< what is shown besides; null: nothing
  /// That acts must carry, where `token` is empty; empty: the pages are read-only.
  std::string act_token{};
  /// Whether there is a coordinator's loop that publishes; else the site is all there is.
  bool has_loop = true;
  /// For a request's head to come, and again for the answer to go.
  std::chrono::milliseconds request_time{3000};
  /// Older numbers than that mean that the coordinator's loop has stalled.
  std::chrono::milliseconds stale_after{5000};
};

/// Serves what the coordinator's loop publishes, from threads of its own: /metrics (Prometheus),
/// /healthz, /readyz, /status (JSON), and a site. One request a connection, bounded in size, number
/// and time. The pages of health need no token, say no more than "ok" without one, and wait for
/// no client: not for slow connections, nor for those who read the other pages.
///
/// The site's pages are for clients with the token; on loopback, without one, for the user of this
/// process and for root. Only the site's acts may be asked for by POST, always with a token,
/// and by no page of another origin.
class HttpServer {
 public:
  /// Errors: BadInput (beyond loopback without a token, no address of this host), Conflict (the
  /// port is taken), Unavailable.
  static Expected<std::unique_ptr<HttpServer>> start(HttpOptions options);
  virtual ~HttpServer() = default;

  /// HOST:PORT, with the real port.
  virtual std::string address() const = 0;
  /// What is shown from now on. Costs a copy; formatting is done by who asks.
  virtual void publish(LiveStatus status) = 0;
};

}  // namespace swarmsmith
