#include "coordinator/service.h"

#include <deque>
#include <map>
#include <mutex>
#include <utility>

#include "access/address.h"
#include "base/log.h"
#include "base/overloaded.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kTick{100};
/// For the last words of workers when all is done.
constexpr Duration kFarewell = std::chrono::seconds(5);
constexpr Duration kRateWindow = std::chrono::seconds(3);
/// Frames that are read before the campaign moves on and answers go out.
constexpr int kFramesAtOnce = 256;
/// A storm of strangers makes a line a reason in this time.
constexpr Duration kSayAgain = std::chrono::seconds(10);

/// What the writer's thread says, for the loop's thread.
class News {
 public:
  explicit News(Wakeup& wakeup) : wakeup_(&wakeup) {}

  void put(const WriterNews& news) {
    {
      const std::scoped_lock lock(mutex_);
      news_ = news;
      fresh_ = true;
    }
    wakeup_->notify();
  }

  bool take(WriterNews& news) {
    const std::scoped_lock lock(mutex_);
    if (!fresh_) return false;
    fresh_ = false;
    news = news_;
    return true;
  }

 private:
  Wakeup* wakeup_;
  std::mutex mutex_;
  WriterNews news_;
  bool fresh_ = false;
};

/// Evaluations a second over the last few.
class Rate {
 public:
  double update(TimePoint now, std::int64_t done) {
    points_.emplace_back(now, done);
    while (points_.size() > 2 && now - points_.front().first > kRateWindow)
      points_.pop_front();
    const double seconds = std::chrono::duration<double>(now - points_.front().first).count();
    return seconds > 0 ? static_cast<double>(done - points_.front().second) / seconds : 0;
  }

 private:
  std::deque<std::pair<TimePoint, std::int64_t>> points_;
};

/// Says who was kept out, seldom.
class RefusalLog {
 public:
  void say(const Refusals& refusals, TimePoint now) {
    for (const auto& [reason, count] : refusals.counts) {
      Said& said = said_[reason];
      if (count == said.count || (said.count > 0 && now - said.when < kSayAgain)) continue;
      const auto from = refusals.last_from.find(reason);
      log(LogLevel::Warning, "coordinator", "connection refused",
          {{"reason", reason},
           {"times", std::to_string(count - said.count)},
           {"last_from", from != refusals.last_from.end() ? from->second : "unknown"}});
      said = {count, now};
    }
  }

 private:
  struct Said {
    std::uint64_t count = 0;
    TimePoint when;
  };
  std::map<std::string, Said> said_;
};

void log_event(const EventRow& event) {
  const LogLevel level = event.severity == "error"     ? LogLevel::Error
                         : event.severity == "warning" ? LogLevel::Warning
                                                       : LogLevel::Info;
  log(level, "coordinator", event.kind, {{"details", event.text}});
}

class Loop final : public Service {
 public:
  Loop(ServiceOptions options, std::unique_ptr<ServerSocket> socket, Store& store,
       WorkSource& source, const std::vector<StoredScore>& known)
      : options_(std::move(options)),
        socket_(std::move(socket)),
        store_(&store),
        coordinator_(options_.coordinator, source, known) {
    store_->set_listener([this](const WriterNews& news) { news_.put(news); });
  }
  ~Loop() override { store_->set_listener({}); }

  const std::string& endpoint() const override { return socket_->endpoint(); }

  ServiceEnd run(const std::stop_token& stop, const ServiceHooks& hooks) override {
    hooks_ = &hooks;
    const std::stop_callback wake(stop, [this] { wakeup_.notify(); });
    carry_out();
    while (true) {
      if (coordinator_.finished()) return finish();
      if (coordinator_.stopped()) return halt(ServiceEnd::How::Stopped, *coordinator_.stopped());
      if (stop.stop_requested()) {
        wait_for_running();
        return halt(ServiceEnd::How::Interrupted, "interrupted; the same command goes on");
      }
      step();
    }
  }

 private:
  void step() {
    const auto left = std::chrono::ceil<milliseconds>(next_tick_ - clock_.now());
    if (!more_frames_) socket_->wait(wakeup_, std::clamp(left, milliseconds{0}, kTick));
    wakeup_.clear();
    const TimePoint now = clock_.now();
    receive(now);
    hear_news();
    // After the frames: what waited in the socket is a sign of life too.
    if (now >= next_tick_ && !more_frames_) {
      look_at_the_door(now);
      coordinator_.on_tick(now);
      report(now);
      next_tick_ = now + kTick;
    }
    carry_out();
  }

  void look_at_the_door(TimePoint now) {
    refusal_log_.say(socket_->refusals(), now);
    if (!options_.new_clients) return;
    const auto clients = options_.new_clients();
    if (!clients) return;
    const std::vector<PeerId> cut = socket_->admit(*clients);
    for (const PeerId peer : cut)
      coordinator_.on_cut_off(peer, now);
    log(LogLevel::Info, "coordinator", "list of clients taken",
        {{"clients", std::to_string(clients->size())}, {"cut_off", std::to_string(cut.size())}});
  }

  void receive(TimePoint now) {
    ServerSocket::Received received;
    more_frames_ = true;
    for (int i = 0; i < kFramesAtOnce; ++i) {
      if (!socket_->receive(received)) {
        more_frames_ = false;
        return;
      }
      coordinator_.on_frame(received.peer, received.frame, now);
    }
  }

  void hear_news() {
    WriterNews news;
    if (!news_.take(news)) return;
    coordinator_.on_committed(news.committed);
    if (news.trouble != trouble_) {
      trouble_ = news.trouble;
      if (trouble_.empty()) {
        log(LogLevel::Info, "coordinator", "store writes again");
      } else {
        log(LogLevel::Error, "coordinator", "store cannot be written; leasing stopped",
            {{"reason", trouble_}});
      }
    }
    coordinator_.hold(stopping_ || !trouble_.empty());
  }

  void carry_out() {
    const TimePoint now = clock_.now();
    bool again = true;
    while (again) {
      again = false;
      for (CoordinatorAction& action : coordinator_.take_actions(now)) {
        again = true;
        std::visit(Overloaded{[&](const SendFrame& send) { this->send(send, now); },
                              [&](AppendRows& append) { this->append(append.rows); }},
                   action);
      }
    }
  }

  void send(const SendFrame& send, TimePoint now) {
    switch (socket_->send(send.peer, send.frame)) {
      case SendStatus::Sent:
        return;
      case SendStatus::Gone:
      // Reads too slowly for a thousand messages: as good as gone; it will say hello again.
      case SendStatus::Full:
        coordinator_.on_unreachable(send.peer, now);
        return;
    }
  }

  void append(std::vector<Row>& rows) {
    for (const Row& row : rows) {
      if (const auto* event = std::get_if<EventRow>(&row)) log_event(*event);
    }
    if (hooks_->on_rows) hooks_->on_rows(rows);
    coordinator_.on_appended(store_->append(std::move(rows)));
  }

  void report(TimePoint now) {
    LiveStatus status = coordinator_.status();
    status.evaluations_per_s = rate_.update(now, status.done);
    status.trouble = trouble_;
    status.insecure_plaintext = options_.insecure_plaintext;
    status.refused = socket_->refusals().counts;
    if (hooks_->on_status) hooks_->on_status(status);
  }

  void wait_for_running() {
    stopping_ = true;
    coordinator_.hold(true);
    const TimePoint until = clock_.now() + options_.grace;
    while (coordinator_.scheduler().leases().leased() > 0 && clock_.now() < until &&
           coordinator_.scheduler().workers().connected() > 0) {
      step();
    }
  }

  ServiceEnd halt(ServiceEnd::How how, std::string reason) {
    coordinator_.hold(true);
    carry_out();
    if (trouble_.empty()) store_->flush();
    hear_news();
    carry_out();
    report(clock_.now());
    return {how, std::move(reason)};
  }

  ServiceEnd finish() {
    coordinator_.drain(clock_.now());
    carry_out();
    store_->flush();
    // A worker that did not hear of the end would look for the coordinator until somebody stops it.
    const TimePoint until = clock_.now() + kFarewell;
    while (coordinator_.scheduler().workers().connected() > 0 && clock_.now() < until)
      step();
    report(clock_.now());
    return {ServiceEnd::How::Finished, {}};
  }

  ServiceOptions options_;
  SystemClock clock_;
  Wakeup wakeup_;
  News news_{wakeup_};
  std::unique_ptr<ServerSocket> socket_;
  Store* store_;
  Coordinator coordinator_;
  const ServiceHooks* hooks_ = nullptr;
  Rate rate_;
  RefusalLog refusal_log_;
  TimePoint next_tick_{};
  std::string trouble_;
  bool more_frames_ = false;
  bool stopping_ = false;
};

}  // namespace

Expected<std::unique_ptr<Service>> Service::open(ServiceOptions options, Store& store,
                                                 WorkSource& source) {
  const bool insisted = options.insecure_plaintext;
  if (options.bind.empty()) options.bind = "tcp://127.0.0.1:*";
  // A name of an interface is what a socket would look for.
  if (constexpr std::string_view kName = "tcp://localhost:"; options.bind.starts_with(kName)) {
    options.bind.replace(0, kName.size(), "tcp://127.0.0.1:");
  }
  const auto address = address_of(options.bind);
  if (!address) {
    return bad_input("this is no address to listen on; it is written 127.0.0.1:5555, host and port",
                     options.bind);
  }
  options.insecure_plaintext = !options.keys && !is_loopback(*address);
  if (options.insecure_plaintext && !insisted) {
    return bad_input(
        "other hosts may connect here, so that keys are needed: make them with `swarmsmith "
        "keygen`, "
        "or listen on tcp://127.0.0.1:PORT",
        options.bind);
  }
  if (options.insecure_plaintext) {
    log(LogLevel::Warning, "coordinator",
        "listening beyond loopback without encryption: whoever reaches the port can read the "
        "campaign, send results and give commands",
        {{"address", options.bind}});
  }
  // The last words of a campaign send its workers home.
  options.socket.linger = milliseconds{200};
  Expected<std::unique_ptr<ServerSocket>> socket =
      ServerSocket::bind(options.bind, options.socket, std::move(options.keys));
  if (!socket) return Unexpected(socket.error());
  const std::vector<StoredScore> known = store.scores();
  return std::make_unique<Loop>(std::move(options), std::move(*socket), store, source, known);
}

}  // namespace swarmsmith
