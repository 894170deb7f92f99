#pragma once

#include <initializer_list>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "base/clock.h"
#include "coordinator/audit.h"
#include "coordinator/done_table.h"
#include "coordinator/event_text.h"
#include "coordinator/lease_table.h"
#include "coordinator/scheduler_types.h"
#include "coordinator/worker_registry.h"
#include "storage/rows.h"

namespace swarmsmith {

/// Who does what, when. Pure: events in with the time, actions out; no socket, no clock, no store.
///
/// Promise: every task that was added, and was not dropped, gets exactly one `OutcomeAccepted`,
/// however often workers die, fall silent, answer twice or late, as long as some worker goes on
/// and the task's campaign is not stopped. A task is evaluated at
/// least once; the first outcome counts, since evaluations are pure. Later ones are compared with
/// it bit by bit.
///
/// When a worker disappears nobody is blamed yet. Workers start tasks in the order of their leases
/// and report 64 results at most at a time, so what ran is among the first (slots + 64) leases:
/// after a death each of these is tried again *alone*, on a worker that has nothing else, and only
/// a death there counts. Three such are a rejection. With programs in place of the simulator the
/// second death is the first that makes it so, and other rules keep their calls few: see
/// SchedulerOptions::evaluates_programs.
class Scheduler {
 public:
  explicit Scheduler(SchedulerOptions options);

  /// These have an outcome that is on disk: their results are acknowledged when they come again.
  void know(std::uint32_t campaign, std::span<const StoredScore> known);

  /// A task that was added as look-ahead and is there still may come once more: it is wanted now.
  void add(std::vector<Task> tasks);
  /// Look-ahead that nobody wants any more; what is leased already goes on.
  void drop(std::span<const PackedKey> keys);
  /// The campaign is stopped: its tasks are forgotten, and what still comes of it is not kept.
  void forget(std::uint32_t campaign);

  void on_hello(PeerId peer, WorkerHello hello, TimePoint now);
  void on_credit(const Sender& sender, std::uint32_t tasks, TimePoint now);
  void on_results(const Sender& sender, std::span<const WorkerResult> results, TimePoint now);
  void on_heartbeat(const Sender& sender, std::uint32_t credit,
                    std::span<const RunningReport> running, TimePoint now,
                    const std::optional<SlotReport>& slots = {});
  void on_returned(const Sender& sender, std::span<const PackedKey> keys, TimePoint now);
  void on_goodbye(const Sender& sender, TimePoint now);
  /// Any other message: a sign of life. False, and a question, when the peer is not known.
  bool on_sign_of_life(const Sender& sender, TimePoint now);
  /// The transport says that the connection is no more.
  void on_unreachable(PeerId peer, TimePoint now);
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
  /// Sends every worker home.
  void drain(TimePoint now);

  std::vector<SchedulerAction> take_actions();

  /// Whether second results are waited for that may still come. Then the campaigns are not over.
  bool is_auditing() const;

  const LeaseTable& leases() const { return leases_; }
  const WorkerRegistry& workers() const { return workers_; }
  const SchedulerCounters& counters() const { return counters_; }
  /// The connection of a worker that is there.
  const WorkerEntry* connected_worker(WorkerNumber number);

 private:
  enum class Loss { Death, Silence, Left, Reconnected };

  WorkerEntry* heard(const Sender& sender, TimePoint now);
  std::string objection_to(const WorkerHello& hello) const;
  void welcome(WorkerEntry& entry, TimePoint now);
  void adopt(WorkerEntry& entry, TimePoint now);
  void take_back_charges(WorkerEntry& entry);
  void lose(WorkerEntry& entry, Loss loss, const std::string& state, TimePoint now);
  void suspect(WorkerEntry& entry, TaskRecord& record, Loss loss);

  void on_score(WorkerEntry& entry, const WorkerResult& result, TimePoint now);
  void on_failure(WorkerEntry& entry, const WorkerResult& result, SendAcknowledged& acknowledged,
                  TimePoint now);
  void on_timeout(WorkerEntry& entry, TaskRecord& record, TimePoint now);
  /// Queues it again; an audit waits again for a worker that may make it.
  void take_back(TaskRecord& record);
  void note_attempt(const TaskRecord& record, const char* outcome, TimePoint now);
  void note_attempt(PackedKey key, const Lease& lease, const char* outcome, TimePoint now);
  void dispatch_audits(TimePoint now);
  void on_audited(WorkerEntry& entry, TaskRecord& record, const DoneEntry& known,
                  const WorkerResult& result, TimePoint now);
  void judge(const WorkerEntry& entry, const DoneEntry& known, const WorkerResult& result);
  /// `worker` failed at what somebody else has done.
  void strike(WorkerNumber worker, TimePoint now);
  void quarantine(WorkerEntry& entry, const std::string& reason, TimePoint now);
  void accept(const Outcome& outcome);
  void repeat(const WorkerEntry& entry, const DoneEntry& known, const WorkerResult& result);
  void reject(TaskRecord& record, WorkerNumber worker, const std::string& reason,
              const FailureDetails& details = {});
  void stop(std::uint32_t campaign, const std::string& reason);
  const CampaignPolicy& policy_of(const TaskRecord& record) const {
    return options_.campaigns[record.task.campaign];
  }

  void pardon(TimePoint now);
  void expire(WorkerEntry& entry, TimePoint now);
  void dispatch_alone(TimePoint now);
  std::int64_t most_for(const WorkerEntry& entry, std::int64_t share) const;
  bool fill(WorkerEntry& entry, std::int64_t share, TimePoint now);
  void send_tasks(WorkerEntry& entry, SendTasks& message, TimePoint now);
  Duration lease_time() const;
  void note(const char* severity, const char* kind, std::initializer_list<EventField> fields,
            std::optional<std::uint32_t> campaign = std::nullopt);

  SchedulerOptions options_;
  LeaseTable leases_;
  WorkerRegistry workers_;
  DoneTable done_;
  Audits audits_;
  SchedulerCounters counters_;
  std::vector<SchedulerAction> actions_;
  double estimate_us_ = 0;  ///< of an evaluation's time
  WorkerNumber turn_ = 0;   ///< who was served last
  TimePoint forgot_;
  TimePoint ticked_;
  TimePoint latest_;  ///< that was said to be now, for the meters
  bool held_ = false;
  bool draining_ = false;
  std::set<std::uint32_t> stopped_;  ///< campaigns
};

}  // namespace swarmsmith
