#include "coordinator/service/http_server.h"

#include <unistd.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <mutex>

#include "base/http/page_server.h"
#include "coordinator/service/metrics_text.h"

namespace swarmsmith {
namespace {

using Clock = std::chrono::steady_clock;

/// Ports after the first one that are tried.
constexpr int kMorePorts = 100;

std::string name_of_this_host() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? std::string(name.data()) : "";
}

class Pages final : public HttpServer {
 public:
  explicit Pages(HttpOptions options)
      : options_(std::move(options)),
        host_name_(name_of_this_host()),
        http_({.door = {.head_time = options_.request_time},
               .answer_time = options_.request_time,
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
    page("/metrics", "text/plain; version=0.0.4; charset=utf-8", metrics_text);
    page("/status", "application/json",
         [](const LiveStatus& status) { return to_json(status) + "\n"; });
  }
  ~Pages() override { http_.stop_serving(); }

  Expected<void> listen() {
    HttpAddress& address = options_.address;
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

  bool is_known(const httplib::Request& request) const {
    return options_.token.empty() ||
           has_token(request.get_header_value("Authorization"), options_.token);
  }

  /// Who may ask for what.
  httplib::Server::HandlerResponse gate(const httplib::Request& request,
                                        httplib::Response& response) {
    const auto refuse = [&](int status, const std::string& why) {
      response.status = status;
      response.set_content(why + "\n", "text/plain");
      return httplib::Server::HandlerResponse::Handled;
    };
    response.set_header("X-Content-Type-Options", "nosniff");
    response.set_header("Cache-Control", "no-store");
    if (request.method != "GET") {
      response.set_header("Allow", "GET");
      return refuse(405, "only GET");
    }
    if (!is_our_host(request.get_header_value("Host"), options_.address, host_name_)) {
      return refuse(421, "this is another host");
    }
    const bool is_open = request.path == "/healthz" || request.path == "/readyz";
    if (!is_open && !is_known(request)) {
      response.set_header("WWW-Authenticate", "Bearer");
      return refuse(401, "a token is needed: Authorization: Bearer TOKEN");
    }
    return httplib::Server::HandlerResponse::Unhandled;
  }

  /// Why no work can be done now; empty when it can.
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
    const std::string text = why.empty() ? "ok" : is_known(request) ? why : "not ready";
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
  mutable std::mutex mutex_;  ///< held to copy a pointer, no longer
  std::shared_ptr<const Published> published_;
};

}  // namespace

Expected<std::unique_ptr<HttpServer>> HttpServer::start(HttpOptions options) {
  const std::string where = to_string(options.address);
  if (options.token.empty() && !is_loopback(options.address)) {
    return bad_input(
        "other hosts could read these pages: give a token by --http-token-file, or listen on "
        "127.0.0.1",
        where);
  }
  auto pages = std::make_unique<Pages>(std::move(options));
  if (auto listening = pages->listen(); !listening) return Unexpected(listening.error());
  return std::unique_ptr<HttpServer>(std::move(pages));
}

}  // namespace swarmsmith
