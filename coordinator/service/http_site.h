#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "coordinator/service/live_status.h"

namespace swarmsmith {

/// What a client that may ask asks for.
struct SiteRequest {
  bool acts = false;   ///< POST; the token was there
  std::string path{};  ///< "/api/v1/live"
  std::map<std::string, std::string> parameters{};
  std::string peer{};  ///< who acts: "anna@127.0.0.1"
  std::string etag{};  ///< of what the asker has already
  bool accepts_gzip = false;
  /// Whether the client has disconnected since; empty: is never asked.
  std::function<bool()> is_gone{};
};

struct SiteAnswer {
  int status = 200;
  std::string type{};
  std::string body{};
  std::vector<std::pair<std::string, std::string>> headers{};
};

/// Pages that an HttpServer shows besides its own, to clients it lets in. Many threads at once.
class HttpSite {
 public:
  virtual ~HttpSite() = default;

  /// Whether each client that names the right host may have it: it holds nothing private.
  virtual bool is_open(std::string_view path) const = 0;
  /// Whether errors of this path are JSON, as its answers are.
  virtual bool is_api(std::string_view path) const = 0;
  /// Paths that may be asked for by POST.
  virtual bool is_act(std::string_view path) const = 0;
  virtual SiteAnswer answer(const SiteRequest& request) = 0;
  /// `{"v":1,"error":{...}}` of what is refused.
  virtual std::string error_json(std::string_view kind, std::string_view message) const = 0;
  /// New numbers of the coordinator's loop; `status` outlives the next call.
  virtual void publish(const LiveStatus& status) = 0;
};

}  // namespace swarmsmith
