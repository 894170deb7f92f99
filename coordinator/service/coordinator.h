#pragma once

#include <google/protobuf/arena.h>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <variant>
#include <vector>

#include "coordinator/design/work_source.h"
#include "coordinator/pool/budgets.h"
#include "coordinator/pool/scheduler.h"
#include "coordinator/pool/slot_account.h"
#include "coordinator/service/live_status.h"
#include "coordinator/service/messages.h"
#include "coordinator/service/pool_rows.h"
#include "storage/store.h"

namespace swarmsmith {

struct CoordinatorOptions {
  SchedulerOptions scheduler;  ///< with a policy for each campaign
  std::string scenario;        ///< serialised pb::PoolScenario; not parsed here
  /// A peer that has sent this many malformed frames is ignored for `refuse_for`.
  int malformed_limit = 10;
  Duration refuse_for = std::chrono::seconds(60);
  BudgetOptions budgets{};
  /// The secret that identifies the workers started by this process; empty: none.
  std::string local_secret;
};

/// A campaign to run.
struct CampaignWork {
  std::string digest;
  WorkSource* source = nullptr;          ///< must outlive the coordinator
  std::span<const StoredScore> known;    ///< the outcomes in its store; read only at the start
  std::span<const CommandRow> commands;  ///< people's commands in its store; read only at the start
  StoredTrust trust{};
};

/// The sender of a frame, as the socket identifies it.
struct Peer {
  PeerId id = 0;
  Role role = Role::Anyone;
  std::string_view client;   ///< name of its key
  std::string_view address;  ///< as the transport reports it
};

/// Actions.
struct SendFrame {
  PeerId peer = 0;
  std::string frame;
  std::vector<PackedKey> leases;  ///< the leases that the frame contains
};
/// Rows to append to the campaign's store in one unit; its ticket comes by `on_appended`, in order.
struct AppendRows {
  std::uint32_t campaign = 0;
  std::vector<Row> rows;
  /// The last `of_pool` rows belong to the pool; the units of all campaigns contain them.
  std::size_t of_pool = 0;
};
/// A client asks for the status; the answer is `status_reply_of`.
struct AnswerStatus {
  PeerId peer = 0;
};
using CoordinatorAction = std::variant<SendFrame, AppendRows, AnswerStatus, AskReferee>;

/// Puts scheduler, campaigns and rows together. Pure: frames and the time in, frames and rows out.
/// Campaigns share only the workers: each campaign has its own source of work and its own store.
///
/// The life of an outcome: the scheduler accepts it, the campaign gets it, its row is appended, the
/// row's ticket is committed, and the worker gets the acknowledgement. The race goes on before the
/// commit; evaluations that a crash loses are repeated and give the same bits. An acknowledged
/// result is on disk, except a result that may never be needed: one made ahead for a candidate that
/// is out of its race.
class Coordinator {
 public:
  /// `campaigns` must have the same order as the scenario and the scheduler's policies.
  Coordinator(CoordinatorOptions options, const std::vector<CampaignWork>& campaigns);

  /// An empty frame means that the message did not consist of a single frame.
  void on_frame(const Peer& peer, std::string_view frame, TimePoint now);
  /// Called when a frame could not be sent because its peer has gone. Earlier messages of the peer,
  /// such as a goodbye, may still be unread, so `on_all_read` decides what the disconnection means.
  void on_unreachable(const SendFrame& unsent);
  bool has_unreachable() const { return !unreachable_.empty(); }
  /// Called when all messages that arrived before this moment have been read.
  void on_all_read(TimePoint now);
  /// The peer's key is no longer valid: its leases go to other workers, and no task is blamed.
  void on_cut_off(PeerId peer, TimePoint now);
  void on_tick(TimePoint now);
  /// The referee's answer to `AskReferee`.
  void on_ruling(const Ruling& ruling, TimePoint now) { scheduler_.on_ruling(ruling, now); }
  void on_appended(std::uint32_t index, std::uint64_t ticket);
  void on_committed(std::uint32_t index, std::uint64_t ticket);
  /// Stops or resumes leasing for all campaigns: disks are too slow, or the process is stopping.
  void hold(Holding holding) {
    holding_ = holding;
    scheduler_.hold(holding != Holding::No);
  }
  /// Stops or resumes leasing for one campaign, whose store cannot write.
  void hold(std::uint32_t campaign, bool held) { scheduler_.hold_design(campaign, 0, held); }
  /// Tells all workers to drain.
  void drain(TimePoint now);

  /// Makes as much progress as possible; returns the actions since the last call, in order.
  std::vector<CoordinatorAction> take_actions(TimePoint now);

  /// Whether every campaign has stopped or needs no more evaluations, all rows are on disk, and no
  /// audit is running.
  bool finished() const;
  /// Whether everything accepted so far is on disk.
  bool settled() const;
  /// The number of the campaign's outcomes that are not on disk yet.
  std::int64_t uncommitted(std::uint32_t campaign) const;
  /// The reason why the campaign cannot go on, if it has stopped. The other campaigns go on.
  const std::optional<std::string>& stopped(std::uint32_t campaign = 0) const {
    return campaigns_[campaign].stopped;
  }

  /// Whether the campaign stopped because scores in its store are wrong or may be wrong.
  bool distrusted(std::uint32_t campaign = 0) const { return campaigns_[campaign].distrusted; }

  /// The paused designs. Their tasks are not leased until they are resumed.
  const std::set<DesignId>& paused(std::uint32_t campaign = 0) const {
    return campaigns_[campaign].paused;
  }

  /// The status without the workers, and without the numbers that need a clock, a socket or a
  /// store; Telemetry adds those.
  LiveStatus status() const;
  /// The workers that are connected, and those that were until recently, by number.
  std::vector<WorkerStatus> fleet(TimePoint now) const;
  std::vector<QuarantineStatus> quarantine(TimePoint now) const;
  const Scheduler& scheduler() const { return scheduler_; }
  /// The number of dropped frames, by the part that was malformed.
  const std::map<std::string, std::uint64_t>& malformed() const { return malformed_; }

 private:
  struct Fault {
    int count = 0;
    TimePoint refused_until;
  };
  /// The workers that get an acknowledgement when the row is on disk.
  struct Waiting {
    WorkerNumber first = 0;
    std::vector<WorkerNumber> others;
  };

  /// A unit of rows for a store, with the acknowledgements that wait for its commit.
  struct Unit {
    std::uint64_t ticket = 0;  ///< 0 until it has one
    std::vector<PackedKey> keys;
    std::vector<SendFrame> replies;
  };
  struct Campaign {
    WorkSource* source;
    std::vector<Row> own_rows{};  ///< events, conflicts, attempts, commands
    std::deque<Unit> unappended{};
    std::deque<Unit> appended{};
    std::vector<SendFrame> replies{};  ///< sent when their rows are on disk
    std::int64_t commands = 0;         ///< the largest number of a command
    std::set<DesignId> paused{};
    std::deque<StoredWord> unaudited{};  ///< scores that an earlier process chose for an audit
    bool all_paused = false;             ///< an event has said that all are paused
    bool told = false;                   ///< it got an outcome or a command since it was last asked
                                         ///< what it drops
    /// It had no more look-ahead work, and nothing has changed that since.
    bool sees_no_further = false;
    std::optional<std::string> stopped{};
    bool distrusted = false;
  };

  // Messages from peers.
  bool is_refused(PeerId peer, TimePoint now);
  void on_malformed(const Peer& peer, const Error& error, TimePoint now);
  void on_message(const Peer& peer, const pb::ToCoordinator& message, TimePoint now);
  void on_work(const Peer& peer, const pb::ToCoordinator& message, TimePoint now);
  void on_hello(const Peer& peer, const pb::ToCoordinator& message, TimePoint now);
  void on_results(const Peer& peer, const pb::ToCoordinator& message, TimePoint now);

  // Commands of people.
  void on_command(const Peer& peer, const pb::Command& command, TimePoint now);
  /// Returns a sentence that says what was done.
  Expected<std::string> forgive(const pb::Command& command, TimePoint now);
  Expected<std::string> obey(std::uint32_t index, const pb::Command& command);
  Expected<std::string> pause(std::uint32_t index, const CommandRow& command);
  Expected<std::uint32_t> campaign_of(const pb::Command& command) const;
  static void note_if_all_is_paused(Campaign& campaign);

  // Decisions of the scheduler, and work that the campaigns want.
  void carry_out(SchedulerAction& action, TimePoint now);
  void send(PeerId peer, std::string frame);
  void audit_stored(std::uint32_t index);
  void close_ended(std::uint32_t index, WorkSource& source);
  bool progress(TimePoint now);
  bool look_ahead();

  // Handling of outcomes.
  void repeat(const OutcomeRepeated& action);
  void put_event(Noted& noted, TimePoint now);
  void put_news(TimePoint now, bool now_or_never = false);
  void append(std::uint32_t index);
  void acknowledge(const std::map<WorkerNumber, std::vector<PackedKey>>& keys);

  CoordinatorOptions options_;
  PoolFacts facts_;
  std::vector<Campaign> campaigns_;
  Budgets budgets_;
  Scheduler scheduler_;
  PoolRows pool_rows_;
  SlotAccount slots_;
  Holding holding_ = Holding::No;
  bool sample_due_ = false;
  std::vector<CoordinatorAction> actions_;
  std::size_t ahead_turn_ = 0;  ///< the campaign that is asked first for look-ahead work
  /// Outcomes that are not on disk yet.
  std::unordered_map<PackedKey, Waiting> waiting_;
  std::unordered_map<PeerId, Fault> faults_;
  /// Peers that have gone, and the leases that could not be sent to them.
  std::map<PeerId, std::vector<PackedKey>> unreachable_;
  std::map<std::string, std::uint64_t> malformed_;
  std::uint64_t malformed_count_ = 0;
  google::protobuf::Arena arena_;
  std::vector<Result> results_;         ///< reused
  std::vector<RunningReport> running_;  ///< reused
};

}  // namespace swarmsmith
