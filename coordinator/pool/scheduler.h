#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/clock.h"
#include "coordinator/design/work_source.h"
#include "coordinator/pool/lost_workers.h"
#include "coordinator/pool/scheduler_types.h"
#include "coordinator/pool/task_book.h"
#include "coordinator/pool/trust.h"
#include "coordinator/pool/worker_registry.h"
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
/// It hands out leases (DesignQueues chooses the design), expires them, and gives idle slots second
/// copies and look-ahead. Whether a result is believed is decided by Trust, what a lost worker
/// means by LostWorkers; TaskBook has what all three work on.
class Scheduler {
 public:
  explicit Scheduler(SchedulerOptions options);

  /// These have an outcome that is on disk: their results are acknowledged when they come again.
  /// Returns those that an earlier process chose to make again, and did not.
  std::deque<StoredWord> know(std::uint32_t campaign, std::span<const StoredScore> known,
                              const StoredTrust& trust = {}) {
    return trust_->know(campaign, known, trust);
  }
  /// Makes one of those again.
  void audit_stored(Task task, Said said) {
    trust_->audit_stored(std::move(task), std::move(said));
  }

  /// A task that was added as look-ahead and is there still may come once more: it is wanted now.
  void add(std::vector<Task> tasks);
  /// Look-ahead that is no longer needed; leased tasks go on.
  void drop(std::span<const PackedKey> keys);
  /// The campaign needs no more results, or needs them again: workers may drop results that this
  /// process did not ask for, such as look-ahead of a coordinator that crashed.
  void close(std::uint32_t campaign, bool closed) { book_->close(campaign, closed); }
  /// Nothing more will be wanted of the design, ever: what is known of its outcomes is forgotten.
  /// Tasks of it that were added go on to their outcomes; other results are acknowledged as
  /// duplicates, and not compared any more.
  void close_design(std::uint32_t campaign, DesignId design) {
    book_->done.close(campaign, design);
  }
  /// The same for those of the design's candidates that are out of its race.
  void close_candidates(std::uint32_t campaign, const PassedCandidates& passed) {
    book_->done.close_candidates(campaign, passed);
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
  /// A worker has started a task that runs alone on it.
  void on_began(const Sender& sender, PackedKey key, TimePoint now);
  /// Lets workers work again, by a key's name, an address or a host's name. Their principal is
  /// on trial as if it were new. Their names; empty when none of them is in quarantine.
  std::vector<std::string> forgive(std::string_view word, const std::string& by, TimePoint now) {
    return trust_->forgive(word, by, now);
  }
  /// What came of `AskReferee`.
  void on_ruling(const Ruling& ruling, TimePoint now) { trust_->on_ruling(ruling, now); }
  /// The task of a `TaskInDispute`; none when the race has not come so far since a restart. Then
  /// the result is not acknowledged, and comes again.
  void on_disputed(PackedKey key, const std::optional<Task>& task, TimePoint now) {
    trust_->on_disputed(key, task, now);
  }
  /// Any other message: a sign of life. False, and a question, when the peer is not known.
  bool on_sign_of_life(const Sender& sender, TimePoint now);
  /// The transport says that the connection has ended, and that these leases never got there.
  void on_unreachable(PeerId peer, TimePoint now, std::span<const PackedKey> undelivered = {});
  /// The peer sent rubbish and is not listened to any more.
  void on_refused(PeerId peer, TimePoint now);
  /// Heartbeats, silent workers, leases without progress; several times a second.
  void on_tick(TimePoint now);

  /// What time it is, for the meters; most events say so, too.
  void on_time(TimePoint now) { book_->now = now; }
  /// Leases what can be leased.
  void dispatch(TimePoint now);
  /// No leases from now on, or again.
  void hold(bool held) { held_ = held; }
  bool held() const { return held_ || draining_; }
  /// A pause: nothing more of the design (0: of the whole campaign) is leased, until it is held no
  /// longer; what is leased goes on. A design is leased of when neither is held.
  void hold_design(std::uint32_t campaign, std::int64_t design, bool held) {
    book_->leases.hold(campaign, design, held);
  }
  bool is_held(std::uint32_t campaign) const { return book_->leases.is_held(campaign, 0); }
  /// How many tasks of look-ahead could be leased now, after `dispatch`; none while anything that
  /// is wanted is queued.
  std::size_t idle_slots() const;
  /// Sends every worker home.
  void drain(TimePoint now);

  std::vector<SchedulerAction> take_actions() { return book_->take_actions(); }

  /// Whether the referee has something to do. Then the campaigns are not over.
  bool is_auditing() const { return !trust_->cases().empty(); }

  const LeaseTable& leases() const { return book_->leases; }
  const WorkerRegistry& workers() const { return *workers_; }
  const Principals& principals() const { return trust_->principals(); }
  const Cases& cases() const { return trust_->cases(); }
  const LeaseSigner& signer() const { return trust_->signer(); }
  const SchedulerCounters& counters() const { return book_->counters; }
  /// The connection of a worker that is there.
  const WorkerEntry* connected_worker(WorkerNumber number);

 private:
  // scheduler.cpp
  WorkerEntry* heard(const Sender& sender, TimePoint now);
  std::string objection_to(const WorkerHello& hello) const;
  void welcome(WorkerEntry& entry, TimePoint now);
  void adopt(WorkerEntry& entry, TimePoint now);
  void on_score(WorkerEntry& entry, const Result& result, TimePoint now);
  void on_failure(WorkerEntry& entry, const Result& result, TimePoint now);
  void on_timeout(WorkerEntry& entry, TaskRecord& record, TimePoint now);

  // scheduler_dispatch.cpp
  void pardon(TimePoint now);
  void expire(WorkerEntry& entry, TimePoint now);
  void dispatch_alone(TimePoint now);
  void dispatch_wanted(TimePoint now);
  std::int64_t most_for(const WorkerEntry& entry, std::int64_t share) const;
  bool is_kept_free(WorkerEntry& entry);
  bool fill(WorkerEntry& entry, std::int64_t share, TimePoint now);
  void put_task(WorkerEntry& entry, const TaskRecord& record, SendTasks& message, TimePoint now);
  void send_tasks(WorkerEntry& entry, SendTasks& message, TimePoint now);
  void copy_stragglers(TimePoint now);
  WorkerEntry* idle_for(const TaskRecord& record);
  Duration copy_time(std::uint32_t campaign) const;
  void dispatch_ahead(TimePoint now);
  bool fill_ahead(WorkerEntry& entry, TimePoint now);
  /// What a lease is charged for.
  std::uint64_t cost_us(std::uint32_t campaign) const;
  Duration lease_time(std::uint32_t campaign) const;

  // On the heap, since they know each other and a scheduler may be moved.
  std::unique_ptr<TaskBook> book_;
  std::unique_ptr<WorkerRegistry> workers_;
  std::unique_ptr<Trust> trust_;
  LostWorkers lost_;
  std::string self_test_;  ///< that a worker must give; empty before the first
  WorkerNumber turn_ = 0;  ///< who was served last
  TimePoint forgot_;
  TimePoint ticked_;
  bool held_ = false;
  bool draining_ = false;
};

}  // namespace swarmsmith
