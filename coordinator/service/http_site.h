#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "coordinator/service/live_status.h"

namespace swarmsmith {

/// A request from a client that has passed the access checks.
struct SiteRequest {
  bool acts = false;   ///< POST; its token was checked
  std::string path{};  ///< such as "/api/v1/live"
  std::map<std::string, std::string> parameters{};
  std::string peer{};  ///< the person who acts, such as "anna@127.0.0.1"
  std::string etag{};  ///< of the version that the client already has
  bool accepts_gzip = false;
  /// Whether the client has disconnected in the meantime; empty: cannot be checked.
  std::function<bool()> is_gone{};
};

struct SiteAnswer {
  int status = 200;
  std::string type{};
  std::string body{};
  std::vector<std::pair<std::string, std::string>> headers{};
};

/// Other pages that an HttpServer serves, to clients with access. Called by many threads at once.
class HttpSite {
 public:
  virtual ~HttpSite() = default;

  /// Whether any client that names the right host may read this path: it has nothing private.
  virtual bool is_open(std::string_view path) const = 0;
  /// Whether errors of this path are JSON, like its answers.
  virtual bool is_api(std::string_view path) const = 0;
  /// Whether this path may be requested by POST.
  virtual bool is_act(std::string_view path) const = 0;
  virtual SiteAnswer answer(const SiteRequest& request) = 0;
  /// The body `{"v":1,"error":{...}}` for a request that is refused.
  virtual std::string error_json(std::string_view kind, std::string_view message) const = 0;
  /// Publishes a new status of the coordinator's loop; `status` stays valid until the next call.
  virtual void publish(const LiveStatus& status) = 0;
};

}  // namespace swarmsmith
