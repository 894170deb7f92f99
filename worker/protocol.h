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

/// The exit codes of a worker process, for batch systems and launchers.
enum class WorkerExit : int {
  Done = 0,  ///< drained: everything was reported or returned
  Usage = 2,
  Unreachable = 5,    ///< no coordinator for ten minutes
  Refused = 7,        ///< the coordinator refuses this build, or this worker cannot run the
                      ///< campaign: a restart does not help
  NoPlace = 8,        ///< there are enough workers, or its key is in quarantine: later it may do
  Interrupted = 143,  ///< a second SIGTERM
};

/// The information with which a worker introduces itself.
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
  std::string secret{};  ///< from the coordinator that started it; empty for others
};

struct WorkerOptions {
  Duration first_backoff = std::chrono::milliseconds(100);
  Duration longest_backoff = std::chrono::seconds(10);
  Duration welcome_timeout = std::chrono::seconds(5);
  Duration give_up_after = std::chrono::minutes(10);
  std::size_t results_per_message = 64;
  /// This does not delay the end of a step: results are sent at once when slots run out of work.
  Duration flush_after = std::chrono::milliseconds(5);
  Duration work_ahead = std::chrono::milliseconds(20);
  Duration grace = std::chrono::seconds(5);
  /// A task that is to run alone may kill this process, so it starts after this delay, when its
  /// coordinator has been informed.
  Duration before_alone = std::chrono::milliseconds(20);
  /// With more unacknowledged results than this, the worker asks for no tasks.
  std::size_t max_unacknowledged = 16'384;
};

/// Actions.
struct OpenConnection {};
struct SendToCoordinator {
  std::string frame;
};
/// A scenario has arrived; call `on_bad_scenario` if it cannot be run.
struct UseScenario {
  std::string scenario;
};
struct RunItems {
  std::vector<LeasedTask> items;
};
/// Take back the items that have not started, and call `on_taken_back` with their keys.
struct TakeBack {};
/// Another campaign is running now: drop all items.
struct DropItems {};
/// A message for the person who runs the worker.
struct Say {
  std::string sentence;
};
/// The process must end.
struct Leave {
  WorkerExit code = WorkerExit::Done;
  std::string reason;
};
using WorkerAction = std::variant<OpenConnection, SendToCoordinator, UseScenario, RunItems,
                                  TakeBack, DropItems, Say, Leave>;

/// The worker's side of the protocol. Pure: events and the time in, actions out.
///
///     waiting ──open──► greeting ──welcome──► active ──drain──► draining ──► left
///        ▲                 │                    │
///        └── no welcome ───┴── lost, silent ────┘
///
/// Results are kept until they are acknowledged; they are sent again after a while and on every new
/// connection. The slots go on with their items while there is no connection.
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
  /// SIGTERM: finish the running items, return the others, say goodbye.
  void on_drain(TimePoint now);
  void on_tick(TimePoint now);

  std::vector<WorkerAction> take_actions();
  /// The latest time at which `on_tick` must be called.
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
  TimePoint retry_;  ///< while waiting: when to connect again
  TimePoint greeted_;
  TimePoint last_heard_;
  TimePoint last_beat_;
  TimePoint ticked_;
  TimePoint alone_since_;  ///< time without a welcome
  Duration heartbeat_ = std::chrono::seconds(1);
  Duration dead_after_ = std::chrono::seconds(5);
  Duration resend_after_ = std::chrono::seconds(10);
  std::uint32_t max_credit_ = kMaxItemsPerMessage;
  std::uint32_t credit_sent_ = 0;

  // The work.
  std::uint64_t scenario_ = 0;  ///< digest of the scenario
  bool has_scenario_ = false;
  TimePoint asked_;         ///< when the scenario was requested
  double estimate_us_ = 0;  ///< average time of an evaluation
  TimePoint welcomed_;
  Duration busy_{0};  ///< slot time of finished evaluations since the welcome
  std::unordered_map<PackedKey, Held> held_;
  std::vector<std::pair<TimePoint, LeasedTask>> announced_;  ///< with the times when they begin
  std::unordered_map<PackedKey, Finished> finished_;         ///< until acknowledged
  std::vector<PackedKey> unsent_;
  TimePoint oldest_unsent_;
  std::deque<std::pair<TimePoint, PackedKey>> sent_;  ///< in the order of sending; may contain
                                                      ///< outdated entries
  std::optional<TimePoint> drain_until_;
};

}  // namespace swarmsmith
