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
  std::string scenario;        ///< serialised pb::PoolScenario; opaque here
  /// A peer whose frames were wrong this often is not listened to for `refuse_for`.
  int malformed_limit = 10;
  Duration refuse_for = std::chrono::seconds(60);
  BudgetOptions budgets{};
  /// That the workers have which this process started; empty for none.
  std::string local_secret;
};

/// A campaign that is to be run.
struct CampaignWork {
  std::string digest;
  WorkSource* source = nullptr;          ///< must outlive the coordinator
  std::span<const StoredScore> known;    ///< outcomes that are in its store; read at the start only
  std::span<const CommandRow> commands;  ///< the same, of what people asked
  StoredTrust trust{};
};

/// Who sent a frame, as the socket knows it.
struct Peer {
  PeerId id = 0;
  Role role = Role::Anyone;
  std::string_view client;   ///< name of its key
  std::string_view address;  ///< as the transport sees it
};

/// Actions.
struct SendFrame {
  PeerId peer = 0;
  std::string frame;
  std::vector<PackedKey> leases;  ///< in the frame
};
/// One unit for the campaign's store; its ticket comes back by `on_appended`, in order.
struct AppendRows {
  std::uint32_t campaign = 0;
  std::vector<Row> rows;
  /// The last so many are of the pool, and in the units of all campaigns.
  std::size_t of_pool = 0;
};
/// A client asks for the status: to be answered with `status_reply_of`.
struct AnswerStatus {
  PeerId peer = 0;
};
using CoordinatorAction = std::variant<SendFrame, AppendRows, AnswerStatus, AskReferee>;

/// Scheduler, campaigns and rows put together. Pure: frames and the time in, frames and rows out.
/// Campaigns share the workers, and nothing else: each has its source of work and its store.
///
/// An outcome goes: accepted by the scheduler, told to the campaign, its row appended, the row's
/// ticket committed, acknowledged to the worker. The race goes on before the commit, and what a
/// crash takes away is evaluated again with the same bits. What was acknowledged is on disk, unless
/// it may never be asked for: a result made ahead for a candidate that is out of its race.
class Coordinator {
 public:
  /// The order of `campaigns` is that of the scenario and of the scheduler's policies.
  Coordinator(CoordinatorOptions options, const std::vector<CampaignWork>& campaigns);

  /// An empty frame stands for a message that was not a single frame.
  void on_frame(const Peer& peer, std::string_view frame, TimePoint now);
  /// The peer of a frame that could not be sent has gone. Its last words may wait to be read, a
  /// goodbye among them: what its end means is decided by `on_all_read`.
  void on_unreachable(const SendFrame& unsent);
  bool has_unreachable() const { return !unreachable_.empty(); }
  /// Nothing waits to be read that came before this.
  void on_all_read(TimePoint now);
  /// The peer's key is not good any more: its leases go to others, and no task is blamed.
  void on_cut_off(PeerId peer, TimePoint now);
  void on_tick(TimePoint now);
  /// What came of `AskReferee`.
  void on_ruling(const Ruling& ruling, TimePoint now) { scheduler_.on_ruling(ruling, now); }
  void on_appended(std::uint32_t index, std::uint64_t ticket);
  void on_committed(std::uint32_t index, std::uint64_t ticket);
  /// No leases from now on, or again: the disks do not keep up, or all is to stop.
  void hold(Holding holding) {
    holding_ = holding;
    scheduler_.hold(holding != Holding::No);
  }
  /// The same for one campaign: its store cannot write.
  void hold(std::uint32_t campaign, bool held) { scheduler_.hold_design(campaign, 0, held); }
  /// Sends the workers home.
  void drain(TimePoint now);

  /// Moves on as far as possible; the actions since the last call, in order.
  std::vector<CoordinatorAction> take_actions(TimePoint now);

  /// Every campaign has stopped or needs no more evaluations, all rows are on disk, and no audit is
  /// running.
  bool finished() const;
  /// Everything accepted so far is on disk.
  bool settled() const;
  /// Outcomes of a campaign that are not on disk yet.
  std::int64_t uncommitted(std::uint32_t campaign) const;
  /// Why the campaign cannot go on, if so. The others do.
  const std::optional<std::string>& stopped(std::uint32_t campaign = 0) const {
    return campaigns_[campaign].stopped;
  }

  /// Whether it stopped because scores in its store are wrong, or may be.
  bool distrusted(std::uint32_t campaign = 0) const { return campaigns_[campaign].distrusted; }

  /// Paused designs. Their tasks are not leased until they are resumed.
  const std::set<DesignId>& paused(std::uint32_t campaign = 0) const {
    return campaigns_[campaign].paused;
  }

  /// Without what needs a clock, a socket or a store: see Telemetry. Without the fleet.
  LiveStatus status() const;
  /// Those that are here, and those that were lately, by number.
  std::vector<WorkerStatus> fleet(TimePoint now) const;
  std::vector<QuarantineStatus> quarantine(TimePoint now) const;
  const Scheduler& scheduler() const { return scheduler_; }
  /// Frames that were dropped, by the part that was wrong.
  const std::map<std::string, std::uint64_t>& malformed() const { return malformed_; }

 private:
  struct Fault {
    int count = 0;
    TimePoint refused_until;
  };
  /// Who is to be acknowledged when the row is on disk.
  struct Waiting {
    WorkerNumber first = 0;
    std::vector<WorkerNumber> others;
  };

  /// Rows that were given out as one, and who waits for them.
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
    std::vector<SendFrame> replies{};  ///< to be sent when their rows are on disk
    std::int64_t commands = 0;         ///< the largest number
    std::set<DesignId> paused{};
    std::deque<StoredWord> unaudited{};  ///< to be made again, as an earlier process chose
    bool all_paused = false;             ///< and it was said
    bool told = false;                   ///< of an outcome, since it was last asked what it drops
    /// It had nothing to look ahead at, and nothing came since that changes this.
    bool sees_no_further = false;
    std::optional<std::string> stopped{};
    bool distrusted = false;
  };

  // What peers send.
  bool is_refused(PeerId peer, TimePoint now);
  void on_malformed(const Peer& peer, const Error& error, TimePoint now);
  void on_message(const Peer& peer, const pb::ToCoordinator& message, TimePoint now);
  void on_work(const Peer& peer, const pb::ToCoordinator& message, TimePoint now);
  void on_hello(const Peer& peer, const pb::ToCoordinator& message, TimePoint now);
  void on_results(const Peer& peer, const pb::ToCoordinator& message, TimePoint now);

  // What people ask.
  void on_command(const Peer& peer, const pb::Command& command, TimePoint now);
  /// A sentence that says what was done.
  Expected<std::string> forgive(const pb::Command& command, TimePoint now);
  Expected<std::string> obey(std::uint32_t index, const pb::Command& command);
  Expected<std::string> pause(std::uint32_t index, const CommandRow& command);
  Expected<std::uint32_t> campaign_of(const pb::Command& command) const;
  static void note_if_all_is_paused(Campaign& campaign);

  // What was decided, and what is wanted.
  void carry_out(SchedulerAction& action, TimePoint now);
  void send(PeerId peer, std::string frame);
  void audit_stored(std::uint32_t index);
  void close_ended(std::uint32_t index, WorkSource& source);
  bool progress(TimePoint now);
  bool look_ahead();

  // What becomes of outcomes.
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
  std::size_t ahead_turn_ = 0;  ///< the campaign that is asked first for look-ahead
  /// Outcomes that are not on disk yet.
  std::unordered_map<PackedKey, Waiting> waiting_;
  std::unordered_map<PeerId, Fault> faults_;
  /// Peers that have gone, and the leases that did not reach them.
  std::map<PeerId, std::vector<PackedKey>> unreachable_;
  std::map<std::string, std::uint64_t> malformed_;
  std::uint64_t malformed_count_ = 0;
  google::protobuf::Arena arena_;
  std::vector<Result> results_;         ///< reused
  std::vector<RunningReport> running_;  ///< reused
};

}  // namespace swarmsmith
