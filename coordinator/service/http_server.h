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
  bool next_port = false;  ///< if the port is taken, try the next hundred ports
  std::string token;       ///< requests must carry it; must not be empty beyond loopback
  /// Other names that the Host header may have, such as this server's name at a proxy.
  std::vector<std::string> names{};
  std::shared_ptr<HttpSite> site{};  ///< other pages to serve; null: none
  /// The token that acts must carry if `token` is empty; both empty: the pages are read-only.
  std::string act_token{};
  /// Whether a coordinator's loop publishes its status here; otherwise only the site is served.
  bool has_loop = true;
  /// Time limit to receive a request's head, and again to send the answer.
  std::chrono::milliseconds request_time{3000};
  /// If the published status is older than this, the coordinator's loop has stalled.
  std::chrono::milliseconds stale_after{5000};
};

/// Serves the status that the coordinator's loop publishes, from threads of its own: /metrics
/// (Prometheus), /healthz, /readyz, /status (JSON), and a site. One request per connection, limited
/// in size, number and time. The health pages need no token, answer only "ok" without one, and are
/// never delayed by other clients, neither by slow connections nor by readers of the other pages.
///
/// The site's pages are for clients with the token; on loopback, without a token, they are for the
/// user of this process and for root. POST is accepted only for the site's acts, always needs a
/// token, and is refused to pages of another origin.
class HttpServer {
 public:
  /// Errors: BadInput (beyond loopback without a token, or not an address of this host), Conflict
  /// (the port is taken), Unavailable.
  static Expected<std::unique_ptr<HttpServer>> start(HttpOptions options);
  virtual ~HttpServer() = default;

  /// HOST:PORT, with the real port.
  virtual std::string address() const = 0;
  /// Sets the status to serve from now on. Costs one copy; the requests' threads do the formatting.
  virtual void publish(LiveStatus status) = 0;
};

}  // namespace swarmsmith
