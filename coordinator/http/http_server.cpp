#include "coordinator/http/http_server.h"

#include <httplib.h>
#include <poll.h>
#include <unistd.h>
#include <array>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include "coordinator/http/metrics_text.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kThreads = 8;
/// Connections that wait for a thread; further ones are closed at once.
constexpr std::size_t kWaiting = 64;
/// Of a request, headers included.
constexpr std::size_t kMostRequestBytes = 16U << 10U;

/// A connection that ends at its deadline, whatever the peer does meanwhile: a byte a second would
/// hold a thread for hours under a time-out for each read.
class DeadlineStream final : public httplib::Stream {
 public:
  DeadlineStream(socket_t socket, Clock::time_point deadline)
      : socket_(socket), deadline_(deadline) {}

  bool is_readable() const override { return wait(POLLIN); }
  bool is_writable() const override { return wait(POLLOUT); }
  ssize_t read(char* data, std::size_t size) override {
    if (read_ >= kMostRequestBytes || !wait(POLLIN)) return -1;
    const ssize_t got = ::recv(socket_, data, std::min(size, kMostRequestBytes - read_), 0);
    if (got > 0) read_ += static_cast<std::size_t>(got);
    return got;
  }
  ssize_t write(const char* data, std::size_t size) override {
    if (!wait(POLLOUT)) return -1;
    return ::send(socket_, data, size, MSG_NOSIGNAL | MSG_DONTWAIT);
  }
  // Nobody asks for these, since nothing is logged about peers.
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  socket_t socket() const override { return socket_; }

 private:
  bool wait(short what) const {
    const auto left = std::chrono::ceil<milliseconds>(deadline_ - Clock::now());
    if (left.count() <= 0) return false;
    pollfd ready{.fd = socket_, .events = what, .revents = 0};
    return ::poll(&ready, 1, static_cast<int>(left.count())) > 0;
  }

  socket_t socket_;
  Clock::time_point deadline_;
  std::size_t read_ = 0;
};

/// Set while a connection is taken only to be closed.
thread_local bool t_shedding = false;

/// The library's pool, with an end to its queue.
class BoundedPool final : public httplib::TaskQueue {
 public:
  BoundedPool() : pool_(kThreads) {}

  void enqueue(std::function<void()> connection) override {
    if (waiting_ >= kWaiting) {
      t_shedding = true;
      connection();
      t_shedding = false;
      return;
    }
    ++waiting_;
    pool_.enqueue([this, connection = std::move(connection)] {
      --waiting_;
      connection();
    });
  }
  void shutdown() override { pool_.shutdown(); }

 private:
  httplib::ThreadPool pool_;
  std::atomic<std::size_t> waiting_ = 0;
};

/// The library's server with our own streams.
class Listener final : public httplib::Server {
 public:
  explicit Listener(milliseconds request_time) : request_time_(request_time) {
    new_task_queue = [] { return new BoundedPool; };
    set_payload_max_length(0);
  }

 private:
  bool process_and_close_socket(socket_t socket) override {
    bool served = false;
    if (!t_shedding) {
      DeadlineStream stream(socket, Clock::now() + request_time_);
      bool closed = false;
      served = process_request(stream, true, closed, nullptr);
    }
    ::shutdown(socket, SHUT_RDWR);
    ::close(socket);
    return served;
  }

  milliseconds request_time_;
};

std::string name_of_this_host() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? std::string(name.data()) : "";
}

class Pages final : public HttpServer {
 public:
  explicit Pages(HttpOptions options)
      : options_(std::move(options)),
        host_name_(name_of_this_host()),
        http_(options_.request_time) {
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
  ~Pages() override {
    http_.stop();
    if (thread_.joinable()) thread_.join();
  }

  bool listen() {
    HttpAddress& address = options_.address;
    const int last = address.port + (options_.next_port ? 100 : 0);
    for (; address.port <= std::min(last, 65535); ++address.port) {
      const bool bound =
          address.port == 0 ? bind_to_any() : http_.bind_to_port(address.host, address.port);
      if (!bound) {
        if (address.port == 0) return false;
        continue;
      }
      thread_ = std::thread([this] { http_.listen_after_bind(); });
      // The library forgets a `stop` that comes before it listens.
      while (!http_.is_running())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      return true;
    }
    return false;
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

  bool bind_to_any() {
    options_.address.port = http_.bind_to_any_port(options_.address.host);
    return options_.address.port > 0;
  }

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
    if (Clock::now() - now->when > options_.stale_after) return "the coordinator's loop stands";
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
  Listener http_;
  std::thread thread_;
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
  if (!pages->listen()) {
    return unexpected(ErrorKind::Conflict,
                      "pages cannot be served here: the port is taken, or the "
                      "host is not this one",
                      where);
  }
  return std::unique_ptr<HttpServer>(std::move(pages));
}

}  // namespace swarmsmith
