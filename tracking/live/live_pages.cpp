#include "tracking/live/live_pages.h"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>

#include "base/http/page_server.h"
#include "base/peer_user.h"
#include "embedded/kLivePage.h"
#include "tracking/video/picture_bytes.h"

namespace swarmsmith {
namespace {

constexpr const char* kHost = "127.0.0.1";
constexpr int kQuality = 80;
/// Each stream occupies a thread; the other threads are for pages and states.
constexpr std::size_t kThreads = 8;
constexpr int kMostStreams = 4;
constexpr std::chrono::seconds kPatience{2};

/// Draws a state over its frame.
void draw_live(ColorImage& image, const LiveScenery& scenery, const LiveState& state) {
  if (scenery.view.has_value()) {
    if (scenery.mission.has_value()) draw_floor(image, *scenery.view, *scenery.mission, {});
    std::vector<OverlayRobot> robots;
    for (const LiveRobot& robot : state.robots)
      if (robot.pose.has_value())
        robots.push_back({robot.name, *robot.pose, robot.height_m,
                          robot.is_seen ? CycleKind::Measured : CycleKind::Missing, robot.trail});
    draw_robots(
        image, *scenery.view,
        scenery.mission.has_value() ? scenery.mission->robot.body.outline : rvr().body.outline,
        robots);
  }
  draw_tags(image, state.tags);
  draw_words(image, {{fmt::format("{:.1f} s  {:.0f} frames/s  delay {:.0f} ms", state.time_s,
                                  state.frames_per_s, 1000 * state.delay_s)},
                     state.issues});
}

/// A state and its picture.
struct Shown {
  LiveState state;
  ColorImage picture;
};

class Pages final : public LivePages {
 public:
  explicit Pages(LiveScenery scenery) : scenery_(std::move(scenery)) {
    http_.set_pre_routing_handler(
        [this](const httplib::Request& request, httplib::Response& response) {
          return gate(request, response);
        });
    http_.Get("/", [](const httplib::Request&, httplib::Response& response) {
      response.set_content(kLivePage, "text/html; charset=utf-8");
    });
    http_.Get("/state.json", [this](const httplib::Request&, httplib::Response& response) {
      show_state(response);
    });
    http_.Get("/frame.jpg", [this](const httplib::Request&, httplib::Response& response) {
      show_frame(response);
    });
    http_.Get("/stream.mjpg", [this](const httplib::Request&, httplib::Response& response) {
      show_stream(response);
    });
  }
  ~Pages() override {
    {
      const std::scoped_lock lock(mutex_);
      stopping_ = true;
    }
    changed_.notify_all();
    http_.stop_serving();
  }

  Expected<void> listen(int port) {
    const Expected<ListeningSocket> listening = listen_for_requests(kHost, port);
    if (!listening) return Unexpected(listening.error());
    port_ = listening->port;
    http_.serve(*listening);
    return {};
  }

  std::string address() const override { return fmt::format("http://{}:{}/", kHost, port_); }
  bool is_watched() const override { return watchers_ > 0; }

  void publish(LiveState state, std::optional<ColorImage> picture) override {
    std::shared_ptr<const Shown> shown;
    if (picture.has_value())
      shown = std::make_shared<const Shown>(Shown{state, std::move(*picture)});
    {
      const std::scoped_lock lock(mutex_);
      state_ = std::move(state);
      if (shown != nullptr) {
        shown_ = std::move(shown);
        ++pictures_;
      }
    }
    changed_.notify_all();
  }

 private:
  /// A client that waits for a picture.
  class Watching {
   public:
    explicit Watching(std::atomic<int>& watchers) : watchers_(&watchers) { ++*watchers_; }
    ~Watching() { --*watchers_; }
    Watching(const Watching&) = delete;
    Watching& operator=(const Watching&) = delete;

   private:
    std::atomic<int>* watchers_;
  };

  /// Refuses requests under another host name that resolves to this host (DNS rebinding), and
  /// requests from another user of this host.
  httplib::Server::HandlerResponse gate(const httplib::Request& request,
                                        httplib::Response& response) const {
    response.set_header("X-Content-Type-Options", "nosniff");
    response.set_header("Cache-Control", "no-store");
    response.set_header("Content-Security-Policy",
                        "default-src 'self'; style-src 'unsafe-inline'; script-src "
                        "'unsafe-inline'; frame-ancestors 'none'");
    const std::string host = request.get_header_value("Host");
    const std::string port = ":" + std::to_string(port_);
    if (host != kHost + port && host != "localhost" + port) {
      response.status = 403;
      response.set_content("ask for 127.0.0.1" + port + "\n", "text/plain");
      return httplib::Server::HandlerResponse::Handled;
    }
    if (!is_of_same_user(PageServer::socket_of_request())) {
      response.status = 403;
      response.set_content("these pages belong to another user of this host\n", "text/plain");
      return httplib::Server::HandlerResponse::Handled;
    }
    if (request.method == "GET") return httplib::Server::HandlerResponse::Unhandled;
    response.status = 405;
    response.set_header("Allow", "GET");
    return httplib::Server::HandlerResponse::Handled;
  }

  /// The next picture after number `after`, with the drawing; empty if none arrived in time.
  std::string next_picture(std::int64_t& after) {
    std::shared_ptr<const Shown> shown;
    {
      std::unique_lock lock(mutex_);
      changed_.wait_for(lock, kPatience, [&] { return pictures_ > after || stopping_; });
      if (stopping_ || pictures_ <= after) return {};
      shown = shown_;
      after = pictures_;
    }
    ColorImage picture = shown->picture;
    draw_live(picture, scenery_, shown->state);
    return jpeg_of(picture, kQuality).value_or("");
  }

  std::int64_t pictures() {
    const std::scoped_lock lock(mutex_);
    return pictures_;
  }
  bool is_stopping() {
    const std::scoped_lock lock(mutex_);
    return stopping_;
  }

  void show_state(httplib::Response& response) {
    std::optional<LiveState> state;
    {
      const std::scoped_lock lock(mutex_);
      state = state_;
    }
    if (!state.has_value()) {
      response.status = 503;
      return response.set_content("no frame came yet\n", "text/plain");
    }
    response.set_content(live_state_json(*state) + "\n", "application/json");
  }

  void show_frame(httplib::Response& response) {
    const Watching watching(watchers_);
    std::int64_t after = pictures();
    const std::string jpeg = next_picture(after);
    if (jpeg.empty()) {
      response.status = 503;
      return response.set_content("no frame came in two seconds\n", "text/plain");
    }
    response.set_content(jpeg, "image/jpeg");
  }

  void show_stream(httplib::Response& response) {
    if (watchers_ >= kMostStreams) {
      response.status = 503;
      return response.set_content("too many streams are open\n", "text/plain");
    }
    const auto watching = std::make_shared<Watching>(watchers_);
    const auto after = std::make_shared<std::int64_t>(pictures());
    response.set_content_provider(
        "multipart/x-mixed-replace; boundary=frame",
        [this, watching, after](std::size_t, httplib::DataSink& sink) {
          const std::string jpeg = next_picture(*after);
          if (is_stopping()) return false;
          // No new picture: the browser keeps the last one, and the stream stays open.
          if (jpeg.empty()) return sink.is_writable();
          const std::string head = fmt::format(
              "--frame\r\nContent-Type: image/jpeg\r\nContent-Length: {}\r\n\r\n", jpeg.size());
          return sink.write(head.data(), head.size()) && sink.write(jpeg.data(), jpeg.size()) &&
                 sink.write("\r\n", 2);
        });
  }

  LiveScenery scenery_;
  std::atomic<int> watchers_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<LiveState> state_;
  std::shared_ptr<const Shown> shown_;
  std::int64_t pictures_ = 0;
  bool stopping_ = false;
  int port_ = 0;
  PageServer http_{{.threads = kThreads, .answer_time = std::nullopt}};
};

}  // namespace

Expected<std::unique_ptr<LivePages>> LivePages::start(int port, LiveScenery scenery) {
  auto pages = std::make_unique<Pages>(std::move(scenery));
  if (auto listening = pages->listen(port); !listening) {
    Error error = listening.error();
    error.message += "; --port 0 takes a free one";
    return Unexpected(error);
  }
  return std::unique_ptr<LivePages>(std::move(pages));
}

}  // namespace swarmsmith
