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

/// Tasks from the wish to the outcome, and what is said of them: what Scheduler, Trust and
/// LostWorkers have in common. It knows how an outcome, a rejection or the end of a campaign is
/// recorded, and leaves to them when.
class TaskBook {
 public:
  explicit TaskBook(SchedulerOptions all);

  const SchedulerOptions options;
  LeaseTable leases;
  DoneTable done;
  SchedulerCounters counters;
  TimePoint now;           ///< the latest that was said
  double estimate_us = 0;  ///< of an evaluation's time, in all campaigns; 0 before the first

  /// Of the campaign, or of all as long as none of it came back.
  double estimate_us_of(std::uint32_t campaign) const;
  void learn(std::uint32_t campaign, std::int64_t wall_us);
  const CampaignPolicy& policy_of(const TaskRecord& record) const {
    return options.campaigns[record.task.campaign];
  }

  /// It has an outcome, or is of a design that is over.
  bool is_done(PackedKey key) const { return done.find(key) != nullptr || done.is_closed(key); }
  /// The task's outcome, once; its record is gone afterwards.
  void accept(const Outcome& outcome);
  /// There is no score. The record is gone afterwards, unless the campaign stops, or would have to
  /// for a task that may never be needed.
  void reject(TaskRecord& record, WorkerNumber worker, const std::string& reason,
              const FailureDetails& details = {});

  void stop(std::uint32_t campaign, const std::string& reason, bool distrusted = false);
  bool is_stopped(std::uint32_t campaign) const { return stopped_.contains(campaign); }
  void forget(std::uint32_t campaign);
  /// Nothing more is wanted of the campaign, or again.
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
  /// A row for the copy that came second, or will; none when there is no copy.
  void note_second_copy(TaskRecord& record, WorkerNumber by, TimePoint at);

 private:
  void note_attempt(PackedKey key, const Lease& lease, AttemptOutcome outcome, TimePoint at);

  std::vector<double> estimates_us_;  ///< by campaign; 0 before the first
  std::vector<bool> closed_;
  std::set<std::uint32_t> stopped_;  ///< campaigns
  std::vector<SchedulerAction> actions_;
};

}  // namespace swarmsmith
