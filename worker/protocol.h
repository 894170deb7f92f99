#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <variant>
#include <vector>

#include "base/clock.h"
#include "base/rng.h"
#include "proto/wire.h"
#include "worker/evaluator.h"

namespace swarmsmith {

/// How a worker process ends, for batch systems and launchers.
enum class WorkerExit : int {
  Done = 0,  ///< drained: everything was reported or given back
  Usage = 2,
  Unreachable = 5,    ///< no coordinator for ten minutes
  Refused = 7,        ///< the coordinator does not want this build: starting it again is useless
  Interrupted = 143,  ///< a second SIGTERM
};

/// How a worker introduces itself.
struct WorkerIdentity {
  std::string id{};  ///< 16 random bytes
  std::string build{};
  int engine_version = 0;
  std::string self_test{};
  int slots = 1;
  std::string host{};
  std::int64_t pid = 0;
  std::string job{};
  std::string cpu{};     ///< model of the processor
  std::string secret{};  ///< given by the coordinator that started it; empty for others
};

struct WorkerOptions {
  Duration first_backoff = std::chrono::milliseconds(100);
  Duration longest_backoff = std::chrono::seconds(10);
  Duration welcome_timeout = std::chrono::seconds(5);
  Duration give_up_after = std::chrono::minutes(10);
  std::size_t results_per_message = 64;
  /// The end of a step waits for nothing, since slots that run dry are said at once.
  Duration flush_after = std::chrono::milliseconds(5);
  Duration work_ahead = std::chrono::milliseconds(20);
  Duration grace = std::chrono::seconds(5);
  /// A task that runs alone may end this process: it begins when its coordinator has been told.
  Duration before_alone = std::chrono::milliseconds(20);
  /// Asks for nothing while it has more results than this that are not acknowledged.
  std::size_t max_unacknowledged = 16'384;
};

/// Actions.
struct OpenConnection {};
struct SendToCoordinator {
  std::string frame;
};
/// A scenario came; `on_bad_scenario` when it cannot be run.
struct UseScenario {
  std::string scenario;
};
struct RunItems {
  std::vector<LeasedTask> items;
};
/// Give back what is not started: `on_taken_back` with the keys.
struct TakeBack {};
/// Another campaign runs now: drop all items.
struct DropItems {};
/// A person at the worker should read it.
struct Say {
  std::string sentence;
};
/// The process is to end.
struct Leave {
  WorkerExit code = WorkerExit::Done;
  std::string reason;
};
using WorkerAction = std::variant<OpenConnection, SendToCoordinator, UseScenario, RunItems,
                                  TakeBack, DropItems, Say, Leave>;

/// A worker's side of the protocol. Pure: events in with the time, actions out.
///
///     waiting ──open──► greeting ──welcome──► active ──drain──► draining ──► left
///        ▲                 │                    │
///        └── no welcome ───┴── lost, silent ────┘
///
/// Results are kept until they are acknowledged, and sent again after a while and on every new
/// connection. Items that are held go on while there is no connection.
class WorkerProtocol {
 public:
  WorkerProtocol(WorkerIdentity identity, WorkerOptions options, Rng jitter);

  void start(TimePoint now);
  void on_frame(std::string_view frame, TimePoint now);
  void on_connection_lost(TimePoint now);
  void on_started(PackedKey key, TimePoint now);
  void on_evaluated(Result result, TimePoint now);
  void on_taken_back(std::span<const PackedKey> keys, TimePoint now);
  void on_bad_scenario(const std::string& reason);
  /// SIGTERM: finish what runs, give back the rest, say goodbye.
  void on_drain(TimePoint now);
  void on_tick(TimePoint now);

  std::vector<WorkerAction> take_actions();
  /// When `on_tick` has something to do at the latest.
  TimePoint next_deadline() const;

  bool active() const { return state_ == State::Active; }
  bool left() const { return state_ == State::Left; }
  std::size_t held() const { return held_.size(); }
  std::size_t unacknowledged() const { return finished_.size(); }

 private:
  enum class State { Waiting, Greeting, Active, Left };

  struct Held {
    std::int64_t attempt = 0;
    std::uint64_t signature = 0;
    std::optional<TimePoint> started{};
  };
  struct Finished {
    Result result;
    bool queued = false;  ///< in `unsent_`
    TimePoint sent;
  };

  void greet(TimePoint now);
  void lose(TimePoint now);
  void leave(WorkerExit code, const std::string& reason);
  void handle(const pb::ToWorker& message, TimePoint now);
  void on_welcome(const pb::Welcome& welcome, TimePoint now);
  void on_reject(const pb::Reject& reject);
  void on_tasks(const pb::Tasks& tasks, TimePoint now);
  void announce(LeasedTask item, TimePoint now);
  void begin_alone(TimePoint now);
  void on_scenario(const pb::ScenarioReply& reply, TimePoint now);
  void be_ready(TimePoint now);
  void queue_result(PackedKey key, Finished& finished, TimePoint now);
  void flush(TimePoint now);
  bool must_flush(TimePoint now) const;
  void send_results(std::span<const PackedKey> keys, TimePoint now);
  void resend(TimePoint now);
  std::uint32_t credit() const;
  void update_credit(TimePoint now);
  void heartbeat(TimePoint now);
  void count_busy(const Held& held, std::int64_t wall_us, TimePoint now);
  void finish_draining(TimePoint now);
  void say_goodbye(TimePoint now, const std::string& reason);
  TimePoint next_of_state() const;
  void send(pb::ToCoordinator& message, TimePoint now);

  WorkerIdentity identity_;
  WorkerOptions options_;
  Rng jitter_;
  State state_ = State::Waiting;
  std::vector<WorkerAction> actions_;
  google::protobuf::Arena arena_;

  // The connection.
  std::uint64_t incarnation_ = 0;
  std::uint64_t sequence_ = 0;
  Duration backoff_;
  TimePoint retry_;  ///< waiting: when to open
  TimePoint greeted_;
  TimePoint last_heard_;
  TimePoint last_beat_;
  TimePoint ticked_;
  TimePoint alone_since_;  ///< without a welcome
  Duration heartbeat_ = std::chrono::seconds(1);
  Duration dead_after_ = std::chrono::seconds(5);
  Duration resend_after_ = std::chrono::seconds(10);
  std::uint32_t max_credit_ = kMaxItemsPerMessage;
  std::uint32_t credit_sent_ = 0;

  // The work.
  std::uint64_t scenario_ = 0;  ///< digest of the campaign's scenario
  bool has_scenario_ = false;
  TimePoint asked_;         ///< for the scenario
  double estimate_us_ = 0;  ///< of an evaluation's time
  TimePoint welcomed_;
  Duration busy_{0};  ///< slot time since then that finished evaluations took
  std::unordered_map<PackedKey, Held> held_;
  std::vector<std::pair<TimePoint, LeasedTask>> announced_;  ///< to begin then
  std::unordered_map<PackedKey, Finished> finished_;         ///< until acknowledged
  std::vector<PackedKey> unsent_;
  TimePoint oldest_unsent_;
  std::deque<std::pair<TimePoint, PackedKey>> sent_;  ///< in order of sending, stale ones too
  std::optional<TimePoint> drain_until_;
};

}  // namespace swarmsmith
