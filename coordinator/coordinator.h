#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <variant>
#include <vector>

#include "coordinator/live_status.h"
#include "coordinator/messages.h"
#include "coordinator/scheduler.h"
#include "coordinator/work_source.h"

namespace swarmsmith {

struct CoordinatorOptions {
  SchedulerOptions scheduler;
  std::string campaign_digest;
  std::string scenario;  ///< serialised pb::Scenario; opaque here
  /// A peer whose frames were wrong this often is not listened to for `refuse_for`.
  int malformed_limit = 10;
  Duration refuse_for = std::chrono::seconds(60);
};

/// Actions.
struct SendFrame {
  PeerId peer = 0;
  std::string frame;
};
/// One unit for the store; its ticket comes back by `on_appended`, in order.
struct AppendRows {
  std::vector<Row> rows;
};
using CoordinatorAction = std::variant<SendFrame, AppendRows>;

/// Scheduler, campaign and rows put together. Pure: frames and the time in, frames and rows out.
///
/// An outcome goes: accepted by the scheduler, told to the campaign, its row appended, the row's
/// ticket committed, acknowledged to the worker. The race goes on before the commit, and what a
/// crash takes away is evaluated again with the same bits; acknowledgements never do.
class Coordinator {
 public:
  /// `source` must outlive the object; `known` are the outcomes that are in the store.
  Coordinator(CoordinatorOptions options, WorkSource& source, std::span<const StoredScore> known);

  /// An empty frame stands for a message that was no single frame.
  void on_frame(PeerId peer, std::string_view frame, TimePoint now);
  void on_unreachable(PeerId peer, TimePoint now);
  /// The peer's key is not good any more: its leases go to others, and nobody is blamed.
  void on_cut_off(PeerId peer, TimePoint now);
  void on_tick(TimePoint now);
  void on_appended(std::uint64_t ticket);
  void on_committed(std::uint64_t ticket);
  /// No leases from now on, or again: the store cannot write, or the campaign is to stop.
  void hold(bool held) { scheduler_.hold(held || stopped_.has_value()); }
  /// Sends the workers home.
  void drain(TimePoint now) { scheduler_.drain(now); }

  /// Moves on as far as possible; the actions since the last call, in order.
  std::vector<CoordinatorAction> take_actions(TimePoint now);

  /// Nothing is wanted any more, and everything is on disk.
  bool finished() const { return source_->finished() && settled(); }
  /// Everything accepted so far is on disk.
  bool settled() const { return waiting_.empty() && unappended_.empty() && appended_.empty(); }
  /// Why the campaign cannot go on, if so.
  const std::optional<std::string>& stopped() const { return stopped_; }

  /// Without rate and trouble, which need a clock and a store.
  LiveStatus status() const;
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

  bool is_refused(PeerId peer, TimePoint now);
  void on_malformed(PeerId peer, const Error& error, TimePoint now);
  void on_message(PeerId peer, const pb::ToCoordinator& message, TimePoint now);
  void on_results(const Sender& sender, const pb::Results& results, TimePoint now);
  void carry_out(SchedulerAction& action);
  void repeat(const OutcomeRepeated& action);
  void acknowledge(const std::map<WorkerNumber, std::vector<PackedKey>>& keys);
  void send(PeerId peer, std::string frame);
  bool progress();
  void append();

  CoordinatorOptions options_;
  CampaignFacts facts_;
  WorkSource* source_;
  Scheduler scheduler_;
  std::vector<CoordinatorAction> actions_;
  std::vector<Row> own_rows_;  ///< workers, events, conflicts
  /// Outcomes that are not on disk yet.
  std::unordered_map<PackedKey, Waiting> waiting_;
  std::deque<std::vector<PackedKey>> unappended_;  ///< keys of AppendRows without a ticket
  std::deque<std::pair<std::uint64_t, std::vector<PackedKey>>> appended_;
  std::unordered_map<PeerId, Fault> faults_;
  std::map<std::string, std::uint64_t> malformed_;
  std::uint64_t malformed_count_ = 0;
  std::optional<std::string> stopped_;
  google::protobuf::Arena arena_;
  std::vector<WorkerResult> results_;   ///< reused
  std::vector<RunningReport> running_;  ///< reused
};

}  // namespace swarmsmith
