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

/// Decides which worker evaluates which task, and when. Pure: events and the time in, actions out;
/// no socket, no clock, no store.
///
/// Guarantee: every task that was added and not dropped gets exactly one `OutcomeAccepted`, however
/// often workers die, become silent, or answer twice or late, as long as some worker remains and
/// the task's campaign is not stopped. A task is evaluated at least once; the first outcome counts,
/// because evaluations are pure. Later results are compared with it bit by bit.
///
/// It grants leases (DesignQueues selects the design), expires them, and gives idle slots second
/// copies and look-ahead. Trust decides whether a result is accepted, and LostWorkers handles lost
/// workers; TaskBook contains the data that all three share.
class Scheduler {
 public:
  explicit Scheduler(SchedulerOptions options);

  /// Registers outcomes that are on disk: their results are acknowledged if they come again.
  /// Returns those that an earlier process selected for an audit that it did not finish.
  std::deque<StoredWord> know(std::uint32_t campaign, std::span<const StoredScore> known,
                              const StoredTrust& trust = {}) {
    return trust_->know(campaign, known, trust);
  }
  /// Audits one of those outcomes.
  void audit_stored(Task task, Said said) {
    trust_->audit_stored(std::move(task), std::move(said));
  }

  /// A task that was added as look-ahead may be added again when it becomes wanted.
  void add(std::vector<Task> tasks);
  /// Drops look-ahead that is no longer needed; leased tasks continue.
  void drop(std::span<const PackedKey> keys);
  /// The campaign needs no more results, or needs them again. While it is closed, workers may drop
  /// results that this process did not ask for, such as look-ahead of a coordinator that crashed.
  void close(std::uint32_t campaign, bool closed) { book_->close(campaign, closed); }
  /// The design will never want anything more, so its known outcomes are forgotten. Its tasks that
  /// were added still get their outcomes; other results are acknowledged as duplicates.
  void close_design(std::uint32_t campaign, DesignId design) {
    book_->done.close(campaign, design);
  }
  /// The same for the design's candidates that are out of its race.
  void close_candidates(std::uint32_t campaign, const PassedCandidates& passed) {
    book_->done.close_candidates(campaign, passed);
  }
  /// The campaign is stopped: its tasks are forgotten, and results that still come are not kept.
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
  /// Ends the quarantine of workers, selected by a key's name, an address or a host's name. Their
  /// principal is on trial again, as if it were new. Returns their names; empty if none were
  /// quarantined.
  std::vector<std::string> forgive(std::string_view word, const std::string& by, TimePoint now) {
    return trust_->forgive(word, by, now);
  }
  /// The answer to `AskReferee`.
  void on_ruling(const Ruling& ruling, TimePoint now) { trust_->on_ruling(ruling, now); }
  /// The task of a `TaskInDispute`; none if the race has not reached it since a restart. Then the
  /// result is not acknowledged, so that it comes again.
  void on_disputed(PackedKey key, const std::optional<Task>& task, TimePoint now) {
    trust_->on_disputed(key, task, now);
  }
  /// Any other message is a sign of life. Asks an unknown peer who it is, and returns false.
  bool on_sign_of_life(const Sender& sender, TimePoint now);
  /// The transport reports that the connection has ended, and that these leases were not delivered.
  void on_unreachable(PeerId peer, TimePoint now, std::span<const PackedKey> undelivered = {});
  /// The peer sent malformed messages and is now ignored.
  void on_refused(PeerId peer, TimePoint now);
  /// Handles heartbeats, silent workers and stalled leases; call it several times a second.
  void on_tick(TimePoint now);

  /// The current time for the meters; most events pass it too.
  void on_time(TimePoint now) { book_->now = now; }
  /// Grants all leases that are possible now.
  void dispatch(TimePoint now);
  /// Stops or resumes leasing.
  void hold(bool held) { held_ = held; }
  bool held() const { return held_ || draining_; }
  /// Pauses or resumes a design (0: the whole campaign): while it is held, none of its tasks are
  /// leased; leased tasks continue. A design's tasks are leased if neither the design nor its
  /// campaign is held.
  void hold_design(std::uint32_t campaign, std::int64_t design, bool held) {
    book_->leases.hold(campaign, design, held);
  }
  bool is_held(std::uint32_t campaign) const { return book_->leases.is_held(campaign, 0); }
  /// The number of look-ahead tasks that could be leased now, after `dispatch`; 0 while a wanted
  /// task is queued.
  std::size_t idle_slots() const;
  /// Tells every worker to drain.
  void drain(TimePoint now);

  std::vector<SchedulerAction> take_actions() { return book_->take_actions(); }

  /// Whether the referee has work. If so, the campaigns are not over.
  bool is_auditing() const { return !trust_->cases().empty(); }

  const LeaseTable& leases() const { return book_->leases; }
  const WorkerRegistry& workers() const { return *workers_; }
  const Principals& principals() const { return trust_->principals(); }
  const Cases& cases() const { return trust_->cases(); }
  const LeaseSigner& signer() const { return trust_->signer(); }
  const SchedulerCounters& counters() const { return book_->counters; }
  /// The entry of a connected worker, or null.
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
  /// The cost that is charged for a lease.
  std::uint64_t cost_us(std::uint32_t campaign) const;
  Duration lease_time(std::uint32_t campaign) const;

  // On the heap, because they refer to each other and a scheduler may be moved.
  std::unique_ptr<TaskBook> book_;
  std::unique_ptr<WorkerRegistry> workers_;
  std::unique_ptr<Trust> trust_;
  LostWorkers lost_;
  std::string self_test_;  ///< that workers must give; empty before the first worker
  WorkerNumber turn_ = 0;  ///< the worker that was served last
  TimePoint forgot_;
  TimePoint ticked_;
  bool held_ = false;
  bool draining_ = false;
};

}  // namespace swarmsmith
