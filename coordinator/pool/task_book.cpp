#include "coordinator/pool/task_book.h"

#include <algorithm>
#include <utility>

#include "base/assert.h"
#include "coordinator/pool/principal.h"
#include "programs/runner.h"

namespace swarmsmith {

TaskBook::TaskBook(SchedulerOptions all)
    : options(std::move(all)),
      estimates_us_(options.campaigns.size()),
      closed_(options.campaigns.size()) {
  SWARMSMITH_ASSERT(!options.campaigns.empty() && options.campaigns.size() <= kMaxCampaigns,
                    "a coordinator has some campaigns, and not too many for its keys");
}

void TaskBook::note(const char* severity, const char* kind,
                    std::initializer_list<EventField> fields, std::optional<std::uint32_t> campaign,
                    const Principal* source, WorkerNumber worker) {
  act(Noted{campaign, pool_event(severity, kind, fields), source != nullptr ? source->name : "",
            worker});
}

void TaskBook::stop(std::uint32_t campaign, const std::string& reason, bool distrusted) {
  // Only the first reason is reported; later ones are often its consequences.
  if (!stopped_.insert(campaign).second) return;
  // A program's output may be long; it is in the table of failures.
  note("error", "campaign stopped", {{"reason", reason.substr(0, reason.find('\n'))}}, campaign);
  act(StopCampaign{campaign, reason, distrusted});
}

void TaskBook::note_attempt(PackedKey key, const Lease& lease, AttemptOutcome outcome,
                            TimePoint at) {
  const auto held = std::chrono::duration_cast<std::chrono::milliseconds>(at - lease.granted);
  act(AttemptEnded{campaign_of(key),
                   {.key = unpack(key),
                    .attempt = lease.attempt,
                    .worker = lease.worker,
                    .held_ms = held.count(),
                    .outcome = outcome}});
}

void TaskBook::note_attempt(TaskRecord& record, WorkerNumber worker, AttemptOutcome outcome,
                            TimePoint at) {
  const Lease* lease = record.lease_of(worker);
  SWARMSMITH_ASSERT(lease != nullptr, "an attempt belongs to a lease");
  note_attempt(key_of(record.task), *lease, outcome, at);
}

void TaskBook::accept(const Outcome& outcome) {
  const PackedKey key = key_of(outcome);
  SWARMSMITH_ASSERT(done.find(key) == nullptr, "a task has one outcome");
  // The lease and the outcome change together: a task is in the table, or it has an outcome.
  leases.remove(key, outcome.worker);
  done.insert(key, outcome.status, outcome.measured);
  CampaignMeters& meters = leases.meters(outcome.campaign);
  const bool ok = outcome.status == EvaluationStatus::Ok;
  ++(ok ? counters.done : counters.rejected);
  ++(ok ? meters.done : meters.rejected);
  act(OutcomeAccepted{outcome});
}

void TaskBook::note_second_copy(TaskRecord& record, WorkerNumber by, TimePoint at) {
  if (!record.second) return;
  for (const Lease* lease : {&*record.lease, &*record.second}) {
    if (lease->worker != by)
      note_attempt(key_of(record.task), *lease, AttemptOutcome::SecondCopy, at);
  }
}

void TaskBook::reject(TaskRecord& record, WorkerNumber worker, const std::string& reason,
                      const FailureDetails& details) {
  const EvaluationKey key = record.task.key;
  if (policy_of(record).stop_on_failure && record.task.ahead) {
    // The task may never be needed, so the campaign does not stop unless it is wanted.
    // It goes to the shelf, and a race that asks for it later promotes it.
    if (record.lease_of(worker) != nullptr) leases.requeue(record, worker);
    if (!record.lease) leases.shelve(record);
    return;
  }
  if (policy_of(record).stop_on_failure) {
    std::string message = "the evaluation of " + name_of(key) + " failed: ";
    message += message_of(reason, details);
    if (!details.command.empty()) message += "It is kept in the table `failure` of the store.";
    return stop(record.task.campaign, message);
  }
  note("warning", "evaluation rejected", {{"evaluation", name_of(key)}, {"reason", reason}},
       record.task.campaign);
  accept({.key = key,
          .campaign = record.task.campaign,
          .status = EvaluationStatus::Rejected,
          .worker = worker,
          .attempt = std::max<std::int64_t>(record.attempts, 1)});
}

void TaskBook::learn(std::uint32_t campaign, std::int64_t wall_us) {
  SWARMSMITH_ASSERT(campaign < estimates_us_.size(), "results are of campaigns that run here");
  const auto spent_us = static_cast<double>(std::max<std::int64_t>(wall_us, 0));
  for (double* estimate : {&estimate_us, &estimates_us_[campaign]})
    // The first value is taken directly; then it is an exponential mean over about the last twenty.
    *estimate += (*estimate == 0 ? 1.0 : 0.05) * (spent_us - *estimate);
}

double TaskBook::estimate_us_of(std::uint32_t campaign) const {
  SWARMSMITH_ASSERT(campaign < estimates_us_.size(), "leases are of campaigns that run here");
  const double own = estimates_us_[campaign];
  // Campaigns of one pool may have evaluations of very different length.
  return own > 0 ? own : estimate_us;
}

void TaskBook::forget(std::uint32_t campaign) {
  stopped_.insert(campaign);
  leases.remove_all(campaign);
}

std::vector<SchedulerAction> TaskBook::take_actions() {
  return std::exchange(actions_, {});
}

}  // namespace swarmsmith
