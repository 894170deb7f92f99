#include "coordinator/service/http_server.h"

#include <strings.h>
#include <algorithm>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>

#include "base/http/page_server.h"
#include "base/peer_user.h"
#include "coordinator/service/http_address.h"
#include "coordinator/service/metrics_text.h"

namespace swarmsmith {
namespace {

using Clock = std::chrono::steady_clock;

/// How many ports after the first one are tried.
constexpr int kMorePorts = 100;

/// Niceness of the threads that answer, so that a race never waits for viewers.
constexpr int kNice = 10;
/// Time limits for answers that take long to compute or are long.
constexpr std::chrono::milliseconds kAnswerTime{20'000};
constexpr std::chrono::milliseconds kExportTime{90'000};

std::optional<std::chrono::milliseconds> time_of(std::string_view path) {
  if (!path.starts_with("/api/")) return std::nullopt;
  return path.ends_with("/export.html") ? kExportTime : kAnswerTime;
}

class Pages final : public HttpServer {
 public:
  explicit Pages(HttpOptions options)
      : options_(std::move(options)),
        host_name_(name_of_this_host()),
        http_({.door = {.head_time = options_.request_time},
               .threads = 12,
               .answer_time = options_.request_time,
               .other_time = [](std::string_view path) { return time_of(path); },
               .nice = options_.site ? kNice : 0,
               .at_once = {"/healthz", "/readyz"}}) {
    http_.set_pre_routing_handler(
        [this](const httplib::Request& request, httplib::Response& response) {
          return gate(request, response);
        });
    http_.Get("/healthz", [](const httplib::Request&, httplib::Response& response) {
      response.set_content("ok\n", "text/plain");
    });
    http_.Get("/readyz", [this](const httplib::Request& request, httplib::Response& response) {
      show_ready(request, response);
    });
    if (!options_.has_loop) return;
    page("/metrics", "text/plain; version=0.0.4; charset=utf-8", metrics_text);
    page("/status", "application/json",
         [](const LiveStatus& status) { return to_json(status).text() + "\n"; });
  }
  ~Pages() override { http_.stop_serving(); }

  Expected<void> listen() {
    Address& address = options_.address;
    const int last = std::min(address.port + (options_.next_port ? kMorePorts : 0), 65535);
    while (true) {
      const Expected<ListeningSocket> listening = listen_for_requests(address.host, address.port);
      if (listening) {
        address.port = listening->port;
        http_.serve(*listening);
        return {};
      }
      const bool taken = listening.error().kind == ErrorKind::Conflict;
      if (!taken || address.port == 0 || address.port == last) return Unexpected(listening.error());
      ++address.port;
    }
  }

  std::string address() const override { return to_string(options_.address); }

  void publish(LiveStatus status) override {
    if (options_.site) options_.site->publish(status);
    auto fresh = std::make_shared<const Published>(Published{std::move(status), Clock::now()});
    const std::scoped_lock lock(mutex_);
    published_.swap(fresh);
  }

 private:
  struct Published {
    LiveStatus status;
    Clock::time_point when;
  };

  std::shared_ptr<const Published> published() const {
    const std::scoped_lock lock(mutex_);
    return published_;
  }

  static bool has_token_of(const httplib::Request& request, const std::string& token) {
    return !token.empty() && has_token(request.get_header_value("Authorization"), token);
  }
  bool is_known(const httplib::Request& request) const {
    return options_.token.empty() || has_token_of(request, options_.token);
  }
  /// Whether the request comes from a user of this host who may not read: without a token, only
  /// root and the user who runs this process may. A client that knows the acts' token is trusted,
  /// whatever the kernel reports.
  bool is_other_user(const httplib::Request& request) const {
    return options_.token.empty() && !is_of_same_user(PageServer::socket_of_request()) &&
           !has_token_of(request, options_.act_token);
  }

  bool is_our_name(const std::string& header) const {
    const auto is = [](std::string_view text, std::string_view name) {
      return text.size() == name.size() && strncasecmp(text.data(), name.data(), text.size()) == 0;
    };
    const std::string_view host = std::string_view(header).substr(0, header.rfind(':'));
    return is_our_host(header, options_.address, host_name_) ||
           std::ranges::any_of(options_.names, [&](const std::string& name) {
             return is(header, name) || is(host, name);
           });
  }

  static bool is_own(std::string_view path) {
    return path == "/healthz" || path == "/readyz" || path == "/metrics" || path == "/status";
  }

  using Handled = httplib::Server::HandlerResponse;

  Handled refuse(const httplib::Request& request, httplib::Response& response, int status,
                 const char* kind, const std::string& why) const {
    response.status = status;
    if (options_.site && options_.site->is_api(request.path)) {
      response.set_content(options_.site->error_json(kind, why), "application/json");
    } else {
      response.set_content(why + "\n", "text/plain");
    }
    return Handled::Handled;
  }

  /// Checks whether the client may make this request.
  Handled gate(const httplib::Request& request, httplib::Response& response) {
    const auto no = [&](int status, const char* kind, const std::string& why) {
      return refuse(request, response, status, kind, why);
    };
    const bool of_site = options_.site && !is_own(request.path);
    response.set_header("X-Content-Type-Options", "nosniff");
    response.set_header("Cache-Control", of_site ? "no-cache" : "no-store");
    const bool is_act = of_site && options_.site->is_act(request.path);
    const char* allowed = is_act ? "POST" : "GET";
    if (request.method != allowed) {
      response.set_header("Allow", allowed);
      return no(405, "bad_method", std::string("only ") + allowed);
    }
    // Before any token: the page of another site can make the browser ask here under the site's own
    // name (DNS rebinding, docs/security.md).
    if (!is_our_name(request.get_header_value("Host"))) {
      return no(421, "other_host",
                "the Host header names another host: use the address that was printed, or start "
                "this program with --http-name and that name");
    }
    if (of_site) return show_site(request, response, is_act);
    const bool is_open = request.path == "/healthz" || request.path == "/readyz";
    if (!is_open && !is_known(request)) return ask_for_token(request, response);
    if (!is_open && is_other_user(request)) return refuse_other_user(request, response);
    return Handled::Unhandled;
  }

  Handled ask_for_token(const httplib::Request& request, httplib::Response& response) const {
    response.set_header("WWW-Authenticate", "Bearer");
    return refuse(request, response, 401, "no_token",
                  "a token is needed: Authorization: Bearer TOKEN");
  }

  Handled refuse_other_user(const httplib::Request& request, httplib::Response& response) const {
    return refuse(request, response, 403, "other_user",
                  "these pages belong to another user of this host; with --http-token-file they "
                  "open to all who have the token");
  }

  /// The client's name, for the store's list of commands.
  static std::string name_of_asker() {
    const int socket = PageServer::socket_of_request();
    const auto user = user_of_peer(socket);
    return (user ? name_of_user(*user) : std::string("somebody")) + "@" + address_of_peer(socket);
  }

  Handled show_site(const httplib::Request& request, httplib::Response& response, bool is_act) {
    HttpSite& site = *options_.site;
    const bool open = site.is_open(request.path);
    if (!open && !is_known(request)) return ask_for_token(request, response);
    if (is_other_user(request)) return refuse_other_user(request, response);
    // Otherwise a page elsewhere could embed pictures from here and make this program compute.
    if (site.is_api(request.path) && is_of_other_page(request))
      return refuse(request, response, 403, "other_origin",
                    "requests from a page of another origin are refused");
    if (is_act) {
      const std::string& token = options_.token.empty() ? options_.act_token : options_.token;
      if (!has_token_of(request, token)) return ask_for_token(request, response);
    }
    SiteRequest asked{.acts = is_act,
                      .path = request.path,
                      .parameters = {},
                      .peer = is_act ? name_of_asker() : std::string(),
                      .etag = request.get_header_value("If-None-Match"),
                      .accepts_gzip = request.get_header_value(PageServer::kAccepts).find("gzip") !=
                                      std::string::npos,
                      .is_gone = PageServer::is_asker_gone};
    for (const auto& [name, value] : request.params)
      asked.parameters[name] = value;
    SiteAnswer answer = site.answer(asked);
    response.status = answer.status;
    for (const auto& [name, value] : answer.headers)
      response.set_header(name, value);
    if (!answer.body.empty()) response.set_content(answer.body, answer.type);
    return Handled::Handled;
  }

  /// Whether the browser's headers show that the request comes from another site's page.
  static bool is_of_other_page(const httplib::Request& request) {
    const std::string site = request.get_header_value("Sec-Fetch-Site");
    if (!site.empty() && site != "same-origin" && site != "none") return true;
    for (const char* header : {"Origin", "Referer"}) {
      const std::string from = request.get_header_value(header);
      if (from.empty()) continue;
      const std::size_t host = from.find("://");
      if (host == std::string::npos) return true;
      const std::string rest = from.substr(host + 3);
      if (rest.substr(0, rest.find('/')) != request.get_header_value("Host")) return true;
    }
    return false;
  }

  /// The reason why no work can be done now; empty if work can be done.
  std::string obstacle() const {
    const auto now = published();
    if (!now) return "starting";
    if (Clock::now() - now->when > options_.stale_after)
      return "the coordinator's loop has stalled";
    return now->status.trouble.empty() ? "" : "a store cannot be written: " + now->status.trouble;
  }

  void show_ready(const httplib::Request& request, httplib::Response& response) const {
    const std::string why = obstacle();
    response.status = why.empty() ? 200 : 503;
    const bool may_know = is_known(request) && !is_other_user(request);
    const std::string text = why.empty() ? "ok" : may_know ? why : "not ready";
    response.set_content(text + "\n", "text/plain");
  }

  template <class Format>
  void page(const char* path, const char* type, const Format& format) {
    http_.Get(path, [this, type, format](const httplib::Request&, httplib::Response& response) {
      const auto now = published();
      if (!now) {
        response.status = 503;
        return response.set_content("starting\n", "text/plain");
      }
      response.set_content(format(now->status), type);
    });
  }

  HttpOptions options_;
  std::string host_name_;
  PageServer http_;
  mutable std::mutex mutex_;  ///< held only to copy a pointer
  std::shared_ptr<const Published> published_;
};

}  // namespace

Expected<std::unique_ptr<HttpServer>> HttpServer::start(HttpOptions options) {
  const std::string where = to_string(options.address);
  if (options.token.empty() && !is_loopback(options.address.host)) {
    return bad_input(
        "other hosts could read these pages: give a token with --http-token-file, or listen on "
        "127.0.0.1",
        where);
  }
  auto pages = std::make_unique<Pages>(std::move(options));
  if (auto listening = pages->listen(); !listening) return Unexpected(listening.error());
  return std::unique_ptr<HttpServer>(std::move(pages));
}

}  // namespace swarmsmith
