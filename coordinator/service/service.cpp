#include "coordinator/service/service.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <iterator>
#include <optional>
#include <utility>

#include "base/log.h"
#include "base/overloaded.h"
#include "coordinator/pool/task_key.h"
#include "coordinator/service/campaign_stores.h"
#include "coordinator/service/front_door.h"
#include "coordinator/service/log_row.h"
#include "coordinator/service/telemetry.h"
#include "proto/wire.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kTick{100};
/// Time for the last messages of workers when everything is done.
constexpr Duration kFarewell = std::chrono::seconds(5);
/// How often the lengths of the write-ahead logs are read.
constexpr Duration kLookAtLogs = std::chrono::seconds(1);
/// The number of outcomes that may wait for a slow disk: some seconds' worth at the highest rates.
/// Above it, leasing stops until half of them are written.
constexpr std::int64_t kMostUncommitted = 500'000;
/// The number of frames read before the campaigns progress and answers are sent.
constexpr int kFramesAtOnce = 256;

std::vector<TelemetryCampaign> telemetry_of(const std::vector<ServiceCampaign>& campaigns) {
  std::vector<TelemetryCampaign> all;
  all.reserve(campaigns.size());
  for (const ServiceCampaign& campaign : campaigns)
    all.push_back({.name = campaign.name,
                   .designs = campaign.designs,
                   .states = campaign.store->design_states(),
                   .tested = campaign.store->tested_designs(),
                   .commands = campaign.store->commands(),
                   .searches = campaign.searches,
                   .max_time = campaign.max_time,
                   .costs = campaign.costs});
  return all;
}

/// In UTC, in the stores' time format.
std::string time_before(double seconds) {
  const auto then = std::chrono::system_clock::now() -
                    std::chrono::duration_cast<std::chrono::system_clock::duration>(
                        std::chrono::duration<double>(seconds));
  const std::time_t time = std::chrono::system_clock::to_time_t(then);
  std::tm parts{};
  gmtime_r(&time, &parts);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts)};
}

std::vector<Searches> searches_of(const std::vector<ServiceCampaign>& campaigns) {
  std::vector<Searches> all;
  all.reserve(campaigns.size());
  for (const ServiceCampaign& campaign : campaigns)
    all.push_back(campaign.searches);
  return all;
}

class Loop final : public Service {
 public:
  Loop(ServiceOptions options, std::unique_ptr<ServerSocket> socket,
       const std::vector<ServiceCampaign>& campaigns, const std::vector<CampaignWork>& works)
      : options_(std::move(options)),
        stores_(campaigns, wakeup_),
        socket_(std::move(socket)),
        referee_(options_.make_referee ? options_.make_referee(options_.coordinator.scenario,
                                                               [this] { wakeup_.notify(); })
                                       : nullptr),
        coordinator_(std::move(options_.coordinator), works),
        telemetry_(telemetry_of(campaigns), clock_.now()),
        row_log_(searches_of(campaigns)) {}

  const std::string& endpoint() const override { return socket_->endpoint(); }

  ServiceEnd run(const std::stop_token& stop, const ServiceHooks& hooks) override {
    hooks_ = &hooks;
    const std::stop_callback wake(stop, [this] { wakeup_.notify(); });
    carry_out();
    while (true) {
      if (stores_.any_lost()) return halt();
      if (coordinator_.finished()) return finish();
      if (stop.stop_requested()) {
        wait_for_running();
        return halt();
      }
      step();
    }
  }

 private:
  void step() {
    const auto left = std::chrono::ceil<milliseconds>(next_tick_ - clock_.now());
    if (!more_frames_ && !coordinator_.has_unreachable())
      socket_->wait(wakeup_, std::clamp(left, milliseconds{0}, kTick));
    wakeup_.clear();
    const TimePoint now = clock_.now();
    receive(now);
    if (!more_frames_) coordinator_.on_all_read(now);
    hear_referee(now);
    hear_news();
    // After the frames, because a message that waited in the socket is a sign of life too.
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
    log_event(
        LogLevel::Info, "coordinator", "list of clients loaded",
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
      telemetry_.on_frame_in(received.frame.size());
      coordinator_.on_frame({received.peer, received.role, received.client, received.address},
                            received.frame, now);
    }
  }

  void hear_referee(TimePoint now) {
    if (referee_ == nullptr) return;
    for (const Ruling& ruling : referee_->take_rulings())
      coordinator_.on_ruling(ruling, now);
  }

  void hear_news() {
    for (std::uint32_t index = 0; index < stores_.count(); ++index) {
      const std::optional<WriterNews> news = stores_.take_news(index);
      if (!news) continue;
      coordinator_.on_committed(index, news->committed);
      telemetry_.on_committed(index, news->committed, clock_.now());
      if (!stores_.update_trouble(index, news->trouble)) continue;
      // The other campaigns can still write their results.
      coordinator_.hold(index, !news->trouble.empty());
      telemetry_.set_trouble(index, news->trouble);
      if (news->is_lost) {
        stores_.set_lost(index);
        log_event(LogLevel::Error, "coordinator", "store is lost", {{"reason", news->trouble}});
      } else if (news->trouble.empty()) {
        log_event(LogLevel::Info, "coordinator", "store writes again");
      } else {
        log_event(LogLevel::Error, "coordinator", "store cannot be written; leasing stopped",
                  {{"reason", news->trouble}});
      }
    }
    coordinator_.hold(holding());
  }

  /// A store that cannot write holds only its own campaign, so it does not count here.
  Holding holding() {
    const std::int64_t most = too_slow_ ? kMostUncommitted / 2 : kMostUncommitted;
    too_slow_ = status_.uncommitted > most;
    if (too_slow_) return Holding::Commit;
    return stopping_ ? Holding::Other : Holding::No;
  }

  void carry_out() {
    const TimePoint now = clock_.now();
    bool again = true;
    while (again) {
      again = false;
      for (CoordinatorAction& action : coordinator_.take_actions(now)) {
        again = true;
        std::visit(Overloaded{[&](const SendFrame& send) { this->send(send); },
                              [&](AppendRows& append) { this->append(append); },
                              [&](const AnswerStatus& answer) { this->answer(answer); },
                              [&](AskReferee& ask) { judge(std::move(ask), now); }},
                   action);
      }
    }
  }

  void send(const SendFrame& send) {
    telemetry_.on_frame_out(send.frame.size());
    switch (socket_->send(send.peer, send.frame)) {
      case SendStatus::Sent:
      // A scenario that could not be sent: the worker asks again.
      case SendStatus::Later:
        return;
      case SendStatus::Gone:
      // The peer reads too slowly and was disconnected: it will say hello again.
      case SendStatus::Full:
        coordinator_.on_unreachable(send);
        return;
    }
  }

  void judge(AskReferee ask, TimePoint now) {
    if (referee_ != nullptr) return referee_->judge(std::move(ask));
    coordinator_.on_ruling({.key = key_of(ask.task),
                            .kind = Ruling::Kind::NoWord,
                            .reason = "this coordinator was started without a referee"},
                           now);
  }

  void append(AppendRows& append) {
    const TimePoint now = clock_.now();
    const std::span<const Row> rows(append.rows);
    tell(append.campaign, rows.first(rows.size() - append.of_pool), now);
    // Every store gets the rows of the pool, but they are logged once.
    if (append.campaign == 0) tell(std::nullopt, rows.last(append.of_pool), now);
    const std::uint64_t ticket = stores_.append(append.campaign, std::move(append.rows));
    telemetry_.on_appended(append.campaign, ticket, now);
    coordinator_.on_appended(append.campaign, ticket);
  }

  void tell(std::optional<std::size_t> campaign, std::span<const Row> rows, TimePoint now) {
    if (rows.empty()) return;
    if (campaign) telemetry_.on_rows(*campaign, rows, now);
    for (const Row& row : rows)
      row_log_.add(campaign, campaign ? stores_.name(*campaign) : "", row);
    if (hooks_->on_rows) hooks_->on_rows(campaign, rows);
  }

  void answer(const AnswerStatus& answer) {
    // Many clients may ask; the JSON is made only once between two ticks.
    if (status_json_.empty()) status_json_ = to_json(status_).text();
    send({answer.peer, status_reply_of(status_json_), {}});
  }

  void report(TimePoint now, bool all = false) {
    if (now - looked_ >= kLookAtLogs) look_at_logs(now);
    status_ = telemetry_.status(coordinator_, now, all);
    for (QuarantineStatus& one : status_.quarantine) {
      if (one.since.empty()) one.since = time_before(one.for_s);
    }
    status_.trouble = stores_.trouble();
    status_.insecure_plaintext = options_.insecure_plaintext;
    status_.refused = socket_->refusals().counts;
    status_json_.clear();
    if (hooks_->on_status) hooks_->on_status(status_);
  }

  void look_at_logs(TimePoint now) {
    looked_ = now;
    stores_.each_log(
        [this](std::size_t index, std::int64_t bytes) { telemetry_.set_wal_bytes(index, bytes); });
  }

  void wait_for_running() {
    stopping_ = true;
    coordinator_.hold(holding());
    const TimePoint until = clock_.now() + options_.grace;
    while (coordinator_.scheduler().leases().leased() > 0 && clock_.now() < until &&
           coordinator_.scheduler().workers().connected() > 0 && !stores_.any_lost()) {
      step();
    }
  }

  ServiceEnd halt() {
    stopping_ = true;
    coordinator_.hold(holding());
    carry_out();
    stores_.flush();
    hear_news();
    carry_out();
    report(clock_.now(), true);
    return {ServiceEnd::How::Interrupted, reasons(), stores_.lost(), distrusted(), unwritten()};
  }

  ServiceEnd finish() {
    coordinator_.drain(clock_.now());
    carry_out();
    stores_.flush();
    hear_news();
    // A worker that is not told that the campaigns have ended would search for the coordinator
    // until a person stops it.
    const TimePoint until = clock_.now() + kFarewell;
    while (coordinator_.scheduler().workers().connected() > 0 && clock_.now() < until)
      step();
    report(clock_.now(), true);
    const std::vector<std::string> stopped = reasons();
    const bool all_well = std::ranges::all_of(stopped, &std::string::empty);
    return {all_well ? ServiceEnd::How::Finished : ServiceEnd::How::Stopped, stopped,
            stores_.lost(), distrusted(), unwritten()};
  }

  std::vector<bool> distrusted() const {
    std::vector<bool> all;
    for (std::uint32_t index = 0; index < stores_.count(); ++index)
      all.push_back(coordinator_.distrusted(index));
    return all;
  }

  std::vector<std::int64_t> unwritten() const {
    std::vector<std::int64_t> all;
    for (std::uint32_t index = 0; index < stores_.count(); ++index)
      all.push_back(coordinator_.uncommitted(index));
    return all;
  }

  std::vector<std::string> reasons() const {
    std::vector<std::string> reasons;
    for (std::uint32_t index = 0; index < stores_.count(); ++index)
      reasons.push_back(coordinator_.stopped(index).value_or(""));
    return reasons;
  }

  ServiceOptions options_;
  SystemClock clock_;
  Wakeup wakeup_;
  CampaignStores stores_;
  std::unique_ptr<ServerSocket> socket_;
  std::unique_ptr<Referee> referee_;
  Coordinator coordinator_;
  const ServiceHooks* hooks_ = nullptr;
  Telemetry telemetry_;
  RowLog row_log_;
  RefusalLog refusal_log_;
  LiveStatus status_;
  std::string status_json_;  ///< `status_` as JSON; empty until a client asks
  TimePoint looked_;
  bool too_slow_ = false;  ///< whether the disk is too slow
  TimePoint next_tick_{};
  bool more_frames_ = false;
  bool stopping_ = false;
};

}  // namespace

Expected<std::unique_ptr<Service>> Service::open(ServiceOptions options,
                                                 std::vector<ServiceCampaign> campaigns) {
  SchedulerOptions& scheduler = options.coordinator.scheduler;
  if (!options.make_referee) {
    for (CampaignPolicy& policy : scheduler.campaigns)
      policy.audit_every = 0;
  }
  for (const ServiceCampaign& campaign : campaigns) {
    const StoredTrust trust = campaign.store->trust();
    std::ranges::copy(trust.quarantined, std::back_inserter(scheduler.quarantined));
  }
  const std::string lasting = options.keys ? options.keys->secret_key
                                           : campaigns.front().store->keep_secret(random_secret());
  scheduler.lease_secret =
      lease_secret_of(lasting, digest_of_scenario(options.coordinator.scenario));
  Expected<std::unique_ptr<ServerSocket>> socket = open_front_door(options);
  if (!socket) return Unexpected(socket.error());
  std::vector<std::vector<StoredScore>> known;
  std::vector<std::vector<CommandRow>> commands;
  std::vector<CampaignWork> works;
  known.reserve(campaigns.size());
  commands.reserve(campaigns.size());
  for (const ServiceCampaign& campaign : campaigns) {
    known.push_back(campaign.store->scores());
    commands.push_back(campaign.store->commands());
    works.push_back({.digest = campaign.digest,
                     .source = campaign.source,
                     .known = known.back(),
                     .commands = commands.back(),
                     .trust = campaign.store->trust()});
  }
  return std::make_unique<Loop>(std::move(options), std::move(*socket), campaigns, works);
}

}  // namespace swarmsmith
