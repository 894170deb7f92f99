#include "worker/service.h"

#include <algorithm>
#include <optional>
#include <random>
#include <string>
#include <utility>

#include "base/log.h"
#include "base/overloaded.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;

/// Time for the last messages to leave the socket.
constexpr milliseconds kLinger{500};
/// Time without a coordinator before a message reports it.
constexpr std::chrono::seconds kLonely{3};
/// While results keep coming, the loop polls this often, and the slots do not wake it for each.
constexpr milliseconds kLookAgain{5};

class Loop {
 public:
  Loop(const WorkerServiceOptions& options, const WorkerIdentity& identity, Pool& pool,
       Wakeup& wakeup)
      : socket_(options.endpoint, options.socket, options.keys),
        // Pauses before a new connection must differ between workers. No result depends on these
        // numbers.
        protocol_(identity, options.protocol, Rng(std::random_device{}())),
        endpoint_(options.endpoint),
        find_(options.find),
        on_connected_(options.on_connected),
        pool_(&pool),
        wakeup_(&wakeup) {}

  WorkerEnd run(const std::atomic<bool>& drain) {
    protocol_.start(clock_.now());
    carry_out();
    while (!end_) {
      socket_.wait(*wakeup_, time_left());
      wakeup_->clear();
      step(drain);
    }
    socket_.close(kLinger);
    return *end_;
  }

 private:
  milliseconds time_left() const {
    Duration left = protocol_.next_deadline() - clock_.now();
    if (busy_) left = std::min<Duration>(left, kLookAgain);
    // Rounded up: a poll of 0 ms would spin until the deadline.
    return std::clamp(std::chrono::ceil<milliseconds>(left), milliseconds{0}, milliseconds{1000});
  }

  void step(const std::atomic<bool>& drain) {
    const TimePoint now = clock_.now();
    // Checked first: messages from before the end are still read below.
    const bool is_lost = socket_.lost();
    std::string frame;
    while (!end_ && socket_.receive(frame)) {
      protocol_.on_frame(frame, now);
      carry_out();
    }
    // Before the events: programs that were killed by the same signal did not fail.
    if (drain.load()) protocol_.on_drain(now);
    take_events(now);
    if (is_lost) {
      tell_why();
      protocol_.on_connection_lost(now);
    }
    protocol_.on_tick(now);
    carry_out();
    tell_when_alone(now);
  }

  void connect() {
    if (find_) {
      const Expected<CoordinatorAddress> found = find_();
      if (!found) {
        socket_.close(milliseconds{0});
        tell_trouble(to_string(found.error()));
        protocol_.on_connection_lost(clock_.now());
        return;
      }
      endpoint_ = found->endpoint;
      socket_.redirect(found->endpoint, found->keys, found->others);
    }
    socket_.connect();
  }

  /// Reports the same problem only once, however many attempts there are.
  void tell_trouble(const std::string& trouble) {
    if (trouble == trouble_) return;
    trouble_ = trouble;
    log_event(LogLevel::Warning, "worker", "cannot connect; trying again", {{"reason", trouble}});
  }

  void tell_why() {
    if (!socket_.trouble().empty()) return tell_trouble(socket_.trouble());
    if (!socket_.refused()) return;
    tell_trouble(
        endpoint_ +
        " refuses this worker's key: it is not in the coordinator's clients.toml, or has expired");
  }

  /// Reports once each time that no coordinator answers.
  void tell_when_alone(TimePoint now) {
    if (std::exchange(connected_, protocol_.active()) != protocol_.active() && on_connected_)
      on_connected_(connected_);
    if (protocol_.active()) {
      active_ = now;
      told_ = false;
      trouble_.clear();
    }
    if (told_ || end_ || now - active_ < kLonely) return;
    told_ = true;
    log_event(LogLevel::Warning, "worker", "no coordinator answers; trying for ten minutes",
              {{"coordinator", endpoint_}});
  }

  void take_events(TimePoint now) {
    std::vector<PoolEvent> events = pool_->take_events();
    bool any_result = false;
    for (PoolEvent& event : events) {
      std::visit(
          Overloaded{[&](const ItemStarted& started) { protocol_.on_started(started.key, now); },
                     [&](Result& result) {
                       any_result = true;
                       protocol_.on_evaluated(std::move(result), now);
                     }},
          event);
    }
    // From now on the loop comes back by itself (`time_left`), and slots need not wake it.
    busy_ = any_result;
    carry_out();
  }

  void carry_out() {
    std::vector<WorkerAction> actions = protocol_.take_actions();
    while (!actions.empty()) {
      for (WorkerAction& action : actions)
        carry_out(action);
      actions = protocol_.take_actions();
    }
  }

  void carry_out(WorkerAction& action) {
    std::visit(Overloaded{[&](OpenConnection) { connect(); },
                          [&](const SendToCoordinator& send) { this->send(send.frame); },
                          [&](const UseScenario& use) {
                            // A scenario is input from outside: this program may lack its flavour,
                            // its program or its engine.
                            const Expected<void> used = pool_->use(use.scenario);
                            if (!used) protocol_.on_bad_scenario(to_string(used.error()));
                          },
                          [&](RunItems& run) { pool_->run(std::move(run.items)); },
                          [&](TakeBack) {
                            take_events(clock_.now());
                            protocol_.on_taken_back(pool_->take_back(), clock_.now());
                          },
                          [&](DropItems) { pool_->take_back(); },
                          [&](const Say& say) {
                            log_event(LogLevel::Warning, "worker", "the coordinator says",
                                      {{"sentence", say.sentence}});
                          },
                          [&](Leave& leave) {
                            if (end_) return;
                            end_ = WorkerEnd{leave.code, std::move(leave.reason)};
                            const bool alone = leave.code == WorkerExit::Unreachable;
                            // "No coordinator" alone would hide a refused key.
                            if (alone && !trouble_.empty()) end_->reason += ": " + trouble_;
                          }},
               action);
  }

  void send(const std::string& frame) {
    // A full queue means that the coordinator does not read; it will be noticed as silent, and
    // important messages are sent again.
    if (socket_.send(frame) == SendStatus::Gone) protocol_.on_connection_lost(clock_.now());
  }

  SystemClock clock_;
  ClientSocket socket_;
  WorkerProtocol protocol_;
  std::string endpoint_;
  std::function<Expected<CoordinatorAddress>()> find_;
  std::function<void(bool)> on_connected_;
  bool connected_ = false;
  std::string trouble_;  ///< that was reported last
  TimePoint active_ = clock_.now();
  bool told_ = false;
  Pool* pool_;
  Wakeup* wakeup_;
  std::optional<WorkerEnd> end_;
  bool busy_ = false;
};

}  // namespace

WorkerEnd serve(const WorkerServiceOptions& options, const WorkerIdentity& identity, Pool& pool,
                Wakeup& wakeup, const std::atomic<bool>& drain) {
  return Loop(options, identity, pool, wakeup).run(drain);
}

}  // namespace swarmsmith
