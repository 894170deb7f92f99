#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "coordinator/pool/done_table.h"
#include "coordinator/pool/event_text.h"
#include "coordinator/pool/lease_table.h"
#include "coordinator/pool/scheduler_types.h"

namespace swarmsmith {

struct Principal;

/// The tasks from request to outcome, and the statements about them: the data shared by Scheduler,
/// Trust and LostWorkers. It knows how to record an outcome, a rejection or the end of a campaign;
/// the others decide when.
class TaskBook {
 public:
  explicit TaskBook(SchedulerOptions all);

  const SchedulerOptions options;
  LeaseTable leases;
  DoneTable done;
  SchedulerCounters counters;
  TimePoint now;           ///< the latest time that was passed in
  double estimate_us = 0;  ///< running estimate of an evaluation's time, over all campaigns; 0
                           ///< before the first

  /// The campaign's estimate, or that of all campaigns until one of its evaluations has come back.
  double estimate_us_of(std::uint32_t campaign) const;
  void learn(std::uint32_t campaign, std::int64_t wall_us);
  const CampaignPolicy& policy_of(const TaskRecord& record) const {
    return options.campaigns[record.task.campaign];
  }

  /// Whether it has an outcome, or belongs to a design that is over.
  bool is_done(PackedKey key) const { return done.find(key) != nullptr || done.is_closed(key); }
  /// Records the task's only outcome, and deletes its record.
  void accept(const Outcome& outcome);
  /// There is no score. Deletes the record, unless the campaign stops, or would have to stop
  /// because of a task that may never be needed.
  void reject(TaskRecord& record, WorkerNumber worker, const std::string& reason,
              const FailureDetails& details = {});

  void stop(std::uint32_t campaign, const std::string& reason, bool distrusted = false);
  bool is_stopped(std::uint32_t campaign) const { return stopped_.contains(campaign); }
  void forget(std::uint32_t campaign);
  /// The campaign wants nothing more, or wants tasks again.
  void close(std::uint32_t campaign, bool closed) { closed_[campaign] = closed; }
  bool is_closed(std::uint32_t campaign) const {
    return campaign < closed_.size() && closed_[campaign];
  }

  template <class Action>
  void act(Action&& action) {
    actions_.emplace_back(std::forward<Action>(action));
  }
  std::vector<SchedulerAction> take_actions();

  void note(const char* severity, const char* kind, std::initializer_list<EventField> fields,
            std::optional<std::uint32_t> campaign = std::nullopt, const Principal* source = nullptr,
            WorkerNumber worker = 0);
  void note_attempt(TaskRecord& record, WorkerNumber worker, AttemptOutcome outcome, TimePoint at);
  /// Notes an attempt for the copy whose result comes second, if there are two copies.
  void note_second_copy(TaskRecord& record, WorkerNumber by, TimePoint at);

 private:
  void note_attempt(PackedKey key, const Lease& lease, AttemptOutcome outcome, TimePoint at);

  std::vector<double> estimates_us_;  ///< by campaign; 0 before the first evaluation
  std::vector<bool> closed_;
  std::set<std::uint32_t> stopped_;  ///< campaigns that were stopped
  std::vector<SchedulerAction> actions_;
};

}  // namespace swarmsmith
