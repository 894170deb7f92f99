#pragma once

#include <deque>
#include <initializer_list>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/clock.h"
#include "coordinator/design/work_source.h"
#include "coordinator/pool/cases.h"
#include "coordinator/pool/done_table.h"
#include "coordinator/pool/event_text.h"
#include "coordinator/pool/lease_signer.h"
#include "coordinator/pool/lease_table.h"
#include "coordinator/pool/principal.h"
#include "coordinator/pool/scheduler_types.h"
#include "coordinator/pool/worker_registry.h"
#include "storage/rows.h"
#include "storage/store.h"

namespace swarmsmith {

/// Who does what, when. Pure: events in with the time, actions out; no socket, no clock, no store.
///
/// Promise: every task that was added, and was not dropped, gets exactly one `OutcomeAccepted`,
/// however often workers die, fall silent, answer twice or late, as long as some worker goes on
/// and the task's campaign is not stopped. A task is evaluated at
/// least once; the first outcome counts, since evaluations are pure. Later ones are compared with
/// it bit by bit.
///
/// Authority (docs/decisions/0019). A result needs the lease of its task: one of this process, or
/// one that it signed. Trust goes by principal (principal.h). In a campaign of the simulator no
/// worker's word rejects an evaluation or stops the campaign: failures, time-outs, deaths and
/// results with other bits are cases for the *referee*, the coordinator's own child process, whose
/// word is the answer. It also makes the first results of a new principal again before they count,
/// and a share of the later ones.
///
/// When a worker disappears nobody is blamed yet. Workers start tasks in the order of their leases
/// and report 64 results at most at a time, so what ran is among the first (slots + 64) leases:
/// after a death of a worker that has proved itself each of these is tried again *alone*, on a
/// worker that has nothing else and says when it begins, and only a death there counts. With
/// programs in place of the simulator three such are a rejection, the second death is the first
/// that makes a task run alone, and other rules keep their calls few: see
/// SchedulerOptions::evaluates_programs.
class Scheduler {
 public:
  explicit Scheduler(SchedulerOptions options);

  /// These have an outcome that is on disk: their results are acknowledged when they come again.
  /// Returns those that an earlier process chose to make again, and did not.
  std::deque<StoredWord> know(std::uint32_t campaign, std::span<const StoredScore> known,
                              const StoredTrust& trust = {});
  /// Makes one of those again.
  void audit_stored(Task task, Said said) { cases_.open(std::move(task), std::move(said), true); }

  /// A task that was added as look-ahead and is there still may come once more: it is wanted now.
  void add(std::vector<Task> tasks);
  /// Look-ahead that nobody wants any more; what is leased already goes on.
  void drop(std::span<const PackedKey> keys);
  /// Nothing more is wanted of the campaign, or again: results that nobody asked for, such as
  /// look-ahead of a coordinator that crashed, need not be kept by their workers.
  void close(std::uint32_t campaign, bool closed) { closed_[campaign] = closed; }
  /// Nothing more will be wanted of the design, ever: what is known of its outcomes is forgotten.
  /// Tasks of it that were added go on to their outcomes; other results are acknowledged as
  /// duplicates, and not compared any more.
  void close_design(std::uint32_t campaign, DesignId design) { done_.close(campaign, design); }
  /// The same for those of the design's candidates that are out of its race.
  void close_candidates(std::uint32_t campaign, const PassedCandidates& passed) {
    done_.close_candidates(campaign, passed);
  }
  /// The campaign is stopped: its tasks are forgotten, and what still comes of it is not kept.
  void forget(std::uint32_t campaign);

  void on_hello(PeerId peer, WorkerHello hello, TimePoint now);
  void on_credit(const Sender& sender, std::uint32_t tasks, TimePoint now);
  void on_results(const Sender& sender, std::span<const Result> results, TimePoint now);
  void on_heartbeat(const Sender& sender, std::uint32_t credit,
                    std::span<const RunningReport> running, TimePoint now,
                    const std::optional<SlotReport>& slots = {});
  void on_returned(const Sender& sender, std::span<const PackedKey> keys, TimePoint now);
  void on_goodbye(const Sender& sender, TimePoint now);
  /// A worker has begun with a task that it runs alone.
  void on_began(const Sender& sender, PackedKey key, TimePoint now);
  /// What came of `AskReferee`.
  void on_ruling(const Ruling& ruling, TimePoint now);
  /// The task of a `TaskInDispute`; none when the race has not come so far since a restart. Then
  /// the result is not acknowledged, and comes again.
  void on_disputed(PackedKey key, const std::optional<Task>& task, TimePoint now);
  /// Any other message: a sign of life. False, and a question, when the peer is not known.
  bool on_sign_of_life(const Sender& sender, TimePoint now);
  /// The transport says that the connection is no more, and that these leases never got there.
  void on_unreachable(PeerId peer, TimePoint now, std::span<const PackedKey> undelivered = {});
  /// The peer sent rubbish and is not listened to any more.
  void on_refused(PeerId peer, TimePoint now);
  /// Heartbeats, silent workers, leases without progress; several times a second.
  void on_tick(TimePoint now);

  /// What time it is, for the meters; most events say so, too.
  void on_time(TimePoint now) { latest_ = now; }
  /// Leases what can be leased.
  void dispatch(TimePoint now);
  /// No leases from now on, or again.
  void hold(bool held) { held_ = held; }
  bool held() const { return held_ || draining_; }
  /// A pause: nothing more of the design (0: of the whole campaign) is leased, until it is held no
  /// longer; what is leased goes on. A design is leased of when neither is held.
  void hold_design(std::uint32_t campaign, std::int64_t design, bool held) {
    leases_.hold(campaign, design, held);
  }
  bool is_held(std::uint32_t campaign) const { return leases_.is_held(campaign, 0); }
  /// How many tasks of look-ahead could be leased now, after `dispatch`; none while anything that
  /// is wanted is queued.
  std::size_t idle_slots() const;
  /// Sends every worker home.
  void drain(TimePoint now);

  std::vector<SchedulerAction> take_actions();

  /// Whether the referee has something to do. Then the campaigns are not over.
  bool is_auditing() const { return !cases_.empty(); }

  const LeaseTable& leases() const { return leases_; }
  const WorkerRegistry& workers() const { return workers_; }
  const Principals& principals() const { return principals_; }
  const Cases& cases() const { return cases_; }
  const LeaseSigner& signer() const { return signer_; }
  const SchedulerCounters& counters() const { return counters_; }
  /// The connection of a worker that is there.
  const WorkerEntry* connected_worker(WorkerNumber number);

 private:
  enum class Loss { Death, Silence, Left, Reconnected };

  WorkerEntry* heard(const Sender& sender, TimePoint now);
  void set_credit(WorkerEntry& entry, std::uint32_t credit);
  std::string objection_to(const WorkerHello& hello) const;
  void welcome(WorkerEntry& entry, TimePoint now);
  void adopt(WorkerEntry& entry, TimePoint now);
  void take_back_charges(WorkerEntry& entry);
  void lose(WorkerEntry& entry, Loss loss, WorkerState state, TimePoint now);
  /// What a loss means for a task that may have run there.
  enum class Blame { Nobody, Task, Rejected };
  Blame blame(WorkerEntry& entry, TaskRecord& record, Loss loss);
  Blame blame_of_program(WorkerEntry& entry, TaskRecord& record, Loss loss);
  std::size_t proven_present() const;

  void on_score(WorkerEntry& entry, const Result& result, TimePoint now);
  void on_failure(WorkerEntry& entry, const Result& result, TimePoint now);
  void on_timeout(WorkerEntry& entry, TaskRecord& record, TimePoint now);
  /// The result becomes the outcome.
  void take(WorkerEntry& entry, TaskRecord& record, const Result& result, TimePoint now);
  void note_attempt(TaskRecord& record, WorkerNumber worker, AttemptOutcome outcome, TimePoint now);
  void note_attempt(PackedKey key, const Lease& lease, AttemptOutcome outcome, TimePoint now);
  void note_second_copy(TaskRecord& record, WorkerNumber by, TimePoint now);

  // trust.cpp
  /// Whether the worker was given the task: it has a lease of it, or the result one that is signed.
  bool may_answer(const WorkerEntry& entry, const Result& result);
  bool is_proven(const Principal& principal) const;
  /// Whether its results wait for what the referee says of its first ones.
  bool is_on_trial(const Principal& principal, std::uint32_t campaign) const;
  void hold_back(WorkerEntry& entry, TaskRecord& record, const Result& result, TimePoint now);
  void try_waiting(Principal& principal, TimePoint now);
  void take_waiting(Principal& principal, TimePoint now);
  bool is_drawn(PackedKey key, double share) const;
  /// Opens a case when the result is one of those that are made again.
  void audit(const TaskRecord& record, const WorkerEntry& entry, const Result& result);
  /// What its workers may hold now.
  void update_room(Principal& principal);
  /// Leases that a stranger's workers had ended without a result.
  void go_astray(Principal& principal, std::size_t leases, TimePoint now);
  void strike(Principal& principal, TimePoint now);
  void convict(Principal& principal, const std::string& evidence, TimePoint now);
  void quarantine(Principal& principal, const std::string& reason, TimePoint now);

  // rulings.cpp
  void claim(WorkerEntry& entry, TaskRecord& record, Said::What what, TimePoint now);
  void ask_referee();
  void note_conflict(PackedKey key, const Dispute& dispute);
  void note_audited(const Said& said, Principal* principal, const Ruling& ruling);
  void on_ruled_word(const Said& said, const Ruling& ruling, TimePoint now);
  void carry_out(const Case& ruled, const Ruling& ruling, TimePoint now);
  void compare_with_stored(const Case& ruled, const Ruling& ruling);
  void let_go(const Said& said);

  /// It has an outcome, or is of a design that is over.
  bool is_done(PackedKey key) const { return done_.find(key) != nullptr || done_.is_closed(key); }
  void dispute(WorkerEntry& entry, const DoneEntry& known, const Result& result);
  void accept(const Outcome& outcome);
  void repeat(WorkerEntry& entry, const Result& result);
  void reject(TaskRecord& record, WorkerNumber worker, const std::string& reason,
              const FailureDetails& details = {});
  void stop(std::uint32_t campaign, const std::string& reason, bool distrusted = false);
  const CampaignPolicy& policy_of(const TaskRecord& record) const {
    return options_.campaigns[record.task.campaign];
  }

  void pardon(TimePoint now);
  void expire(WorkerEntry& entry, TimePoint now);
  void dispatch_alone(TimePoint now);
  void dispatch_wanted(TimePoint now);
  std::int64_t most_for(const WorkerEntry& entry, std::int64_t share) const;
  bool is_kept_free(WorkerEntry& entry);
  bool fill(WorkerEntry& entry, std::int64_t share, TimePoint now);
  void put_task(WorkerEntry& entry, const TaskRecord& record, SendTasks& message, TimePoint now);
  void send_tasks(WorkerEntry& entry, SendTasks& message, TimePoint now);

  // idle_slots.cpp
  void copy_stragglers(TimePoint now);
  WorkerEntry* idle_for(const TaskRecord& record);
  Duration copy_time(std::uint32_t campaign) const;
  void dispatch_ahead(TimePoint now);
  bool fill_ahead(WorkerEntry& entry, TimePoint now);

  /// Of an evaluation of the campaign, or of all as long as none came back; 0 without any.
  double estimate_us(std::uint32_t campaign) const;
  void learn(std::uint32_t campaign, std::int64_t wall_us);
  /// What a lease is charged for.
  std::uint64_t cost_us(std::uint32_t campaign) const;
  Duration lease_time(std::uint32_t campaign) const;
  void note(const char* severity, const char* kind, std::initializer_list<EventField> fields,
            std::optional<std::uint32_t> campaign = std::nullopt, const Principal* source = nullptr,
            WorkerNumber worker = 0);

  SchedulerOptions options_;
  LeaseTable leases_;
  Principals principals_;
  WorkerRegistry workers_;
  DoneTable done_;
  Cases cases_;
  /// Results with other bits than the outcome's, whose tasks are asked for.
  std::unordered_map<PackedKey, std::vector<Dispute>> disputed_;
  LeaseSigner signer_;
  double referee_us_ = 0;  ///< of one of its evaluations
  SchedulerCounters counters_;
  std::vector<SchedulerAction> actions_;
  double estimate_us_ = 0;            ///< of an evaluation's time, in all campaigns
  std::vector<bool> closed_;          ///< campaigns
  std::vector<double> estimates_us_;  ///< by campaign; 0 before the first
  WorkerNumber turn_ = 0;             ///< who was served last
  TimePoint forgot_;
  TimePoint ticked_;
  TimePoint latest_;  ///< that was said to be now, for the meters
  bool held_ = false;
  bool draining_ = false;
  std::set<std::uint32_t> stopped_;  ///< campaigns
};

}  // namespace swarmsmith
