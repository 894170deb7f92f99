#include "coordinator/launchers/slurm_jobs.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "base/plain_text.h"

namespace swarmsmith {
namespace {

/// A job that ran at least this long was a working worker.
constexpr Duration kShortJob = std::chrono::seconds(30);
constexpr int kMostQuickEnds = 5;

enum class Phase { Pending, Running, Leaving, Cancelled, Failed, Ended };

/// States as listed in squeue(1). A job in an unknown state counts as still there.
Phase phase_of(const std::string& state) {
  static const std::set<std::string> kPending = {"PENDING",      "CONFIGURING",  "REQUEUED",
                                                 "REQUEUE_FED",  "SUSPENDED",    "REQUEUE_HOLD",
                                                 "SPECIAL_EXIT", "RESV_DEL_HOLD"};
  static const std::set<std::string> kEnded = {"COMPLETED", "TIMEOUT",  "PREEMPTED", "NODE_FAIL",
                                               "BOOT_FAIL", "DEADLINE", "REVOKED"};
  if (kPending.contains(state)) return Phase::Pending;
  if (state == "COMPLETING") return Phase::Leaving;
  if (state == "CANCELLED") return Phase::Cancelled;
  if (state == "FAILED" || state == "OUT_OF_MEMORY") return Phase::Failed;
  return kEnded.contains(state) ? Phase::Ended : Phase::Running;
}

/// Reasons of squeue(1) that stay until a person acts.
bool is_for_good(const std::string& reason) {
  static const std::set<std::string> kReasons = {
      "AccountNotAllowed", "BadConstraints",     "InvalidAccount",     "InvalidQOS",
      "JobHeldAdmin",      "JobHeldUser",        "PartitionConfig",    "PartitionDown",
      "QOSNotAllowed",     "PartitionNodeLimit", "PartitionTimeLimit", "PartitionInactive"};
  return kReasons.contains(reason);
}

bool is_live(Phase phase) {
  return phase == Phase::Pending || phase == Phase::Running || phase == Phase::Leaving;
}

/// Whether a message of sbatch or squeue means that Slurm is temporarily unavailable, and not that
/// the request is wrong.
bool passes_by_itself(std::string_view message) {
  static constexpr std::array<std::string_view, 7> kSigns = {"Unable to contact slurm controller",
                                                             "Socket timed out",
                                                             "temporarily unable",
                                                             "Zero Bytes were transmitted",
                                                             "Connection refused",
                                                             "did not answer in time",
                                                             "backup controller"};
  return std::ranges::any_of(
      kSigns, [&](std::string_view sign) { return message.find(sign) != std::string_view::npos; });
}

}  // namespace

std::vector<QueuedJob> parse_queue(std::string_view text) {
  std::vector<QueuedJob> jobs;
  for (const std::string_view line : split_lines(text)) {
    const std::size_t first = line.find('|');
    const std::size_t second = first == std::string_view::npos ? first : line.find('|', first + 1);
    if (second == std::string_view::npos) continue;
    jobs.push_back({.id = std::string(line.substr(0, first)),
                    .state = std::string(line.substr(first + 1, second - first - 1)),
                    .reason = std::string(line.substr(second + 1))});
  }
  return jobs;
}

SlurmJobs::SlurmJobs(std::int64_t wanted, SlurmTimes times, Rng jitter)
    : wanted_(wanted),
      times_(times),
      pause_(times.first_pause, times.longest_pause, jitter),
      poll_(times.first_poll) {}

SlurmJobs::Action SlurmJobs::next(TimePoint now) {
  if (asked_ || !trouble_.empty()) return Nothing{};
  if (to_submit_ > 0) {
    asked_ = true;
    return Submit{std::exchange(to_submit_, 0)};
  }
  if (now < look_at_) return Nothing{};
  asked_ = true;
  return LookAtQueue{};
}

/// Updates the record of how long jobs ran, for jobs that are running or have just ended.
void SlurmJobs::note_life(const std::vector<QueuedJob>& jobs, TimePoint now) {
  for (const QueuedJob& job : jobs) {
    const auto since = running_since_.find(job.id);
    const bool lived = since != running_since_.end() && now - since->second >= kShortJob;
    if (phase_of(job.state) == Phase::Running) {
      running_since_.try_emplace(job.id, now);
      if (lived) quick_ends_ = 0;
      continue;
    }
    const auto before = states_.find(job.id);
    const bool was_live = before == states_.end() ? seen_ : is_live(phase_of(before->second));
    if (was_live && job.state == "COMPLETED" && !lived) {
      ++quick_ends_;
      if (quick_ends_ == kMostQuickEnds) {
        trouble_ = "jobs end as soon as they run, and without an error (job " + job.id +
                   "); is their program swarmsmith-worker? The job's log says more";
      }
    }
    if (since != running_since_.end() && !is_live(phase_of(job.state))) running_since_.erase(since);
  }
}

void SlurmJobs::count(const std::vector<QueuedJob>& jobs, TimePoint now) {
  note_life(jobs, now);
  std::map<std::string, std::int64_t> reasons;
  std::int64_t cancelled = 0;
  // Jobs that ended before, and whose replacements wait for their time or were refused.
  std::int64_t replaceable = std::max<std::int64_t>(0, wanted_ - running_ - pending_ - leaving_);
  running_ = pending_ = leaving_ = 0;
  std::map<std::string, std::string> states;
  for (const QueuedJob& job : jobs) {
    const Phase phase = phase_of(job.state);
    states[job.id] = job.state;
    running_ += phase == Phase::Running ? 1 : 0;
    leaving_ += phase == Phase::Leaving ? 1 : 0;
    if (phase == Phase::Pending) {
      ++pending_;
      ++reasons[job.reason];
    }
    const auto before = states_.find(job.id);
    const bool was_live = before != states_.end() && is_live(phase_of(before->second));
    // Jobs that ended before this launcher started do not count.
    const bool is_new = before == states_.end() && seen_;
    if (is_live(phase) || (!was_live && !is_new)) continue;
    if (phase == Phase::Cancelled) ++cancelled;
    if (phase == Phase::Failed) failed_job_ = job.id;
    if (phase != Phase::Cancelled) ++replaceable;
  }
  // Slurm forgets ended jobs after some minutes.
  for (const auto& [id, state] : states_)
    replaceable += !states.contains(id) && is_live(phase_of(state)) ? 1 : 0;
  // A person who cancels jobs wants fewer workers (docs/cluster.md, "Slurm"). Jobs submitted by
  // hand count too, so cancelling one of them need not change the number.
  if (cancelled > 0) {
    wanted_ = std::min(wanted_, running_ + pending_ + leaving_ + replaceable);
  }
  waits_for_.clear();
  for (const auto& [reason, times] : reasons) {
    if (reason == "None") continue;
    if (waits_for_.empty() || times > reasons[waits_for_]) waits_for_ = reason;
  }
  states_ = std::move(states);
}

void SlurmJobs::on_queue(const std::vector<QueuedJob>& jobs, TimePoint now) {
  asked_ = false;
  queue_note_.clear();
  const auto before = std::pair(running_, pending_);
  count(jobs, now);
  seen_ = true;
  if (running_ + pending_ > 0) submitted_ = true;
  const bool changed = before != std::pair(running_, pending_);
  poll_ = changed ? times_.first_poll : std::min(times_.longest_poll, poll_ * 3 / 2);
  look_at_ = now + poll_;
  plan(now);
}

void SlurmJobs::plan(TimePoint now) {
  const std::int64_t missing = wanted_ - running_ - pending_ - leaving_;
  if (missing <= 0) return;
  if (now >= submit_at_) {
    to_submit_ = missing;
  } else {
    look_at_ = std::min(look_at_, submit_at_);
  }
}

void SlurmJobs::on_no_queue(const std::string& message, TimePoint now) {
  asked_ = false;
  queue_note_ = "Slurm does not show its queue: " + message;
  if (!seen_ && !passes_by_itself(message)) trouble_ = queue_note_;
  poll_ = std::min(times_.longest_poll, poll_ * 2);
  look_at_ = now + poll_;
}

void SlurmJobs::on_submitted(std::int64_t jobs, TimePoint now) {
  asked_ = false;
  submitted_ = true;
  submit_note_.clear();
  pending_ += jobs;
  if (now - last_submit_ > 2 * times_.longest_pause) pause_.reset();
  last_submit_ = now;
  submit_at_ = now + pause_.next();
  poll_ = times_.first_poll;
  look_at_ = now + poll_;
}

void SlurmJobs::on_refused(const std::string& message, TimePoint now) {
  asked_ = false;
  submit_note_ = "Slurm refuses jobs: " + message;
  if (!submitted_ && !passes_by_itself(message)) trouble_ = submit_note_;
  submit_at_ = now + pause_.next();
  look_at_ = submit_at_;
}

LauncherStatus SlurmJobs::status() const {
  LauncherStatus status{.name = "slurm",
                        .wanted = wanted_,
                        .running = running_,
                        .pending = pending_,
                        .waits_for = waits_for_};
  status.note = !submit_note_.empty() ? submit_note_ : queue_note_;
  if (status.note.empty() && is_for_good(waits_for_)) {
    status.note = "Slurm holds jobs back (" + waits_for_ + ") and will not start them like this: " +
                  "see CPUs, time and partition of [workers.slurm]";
  }
  if (status.note.empty() && !failed_job_.empty()) {
    status.note = "job " + failed_job_ + " failed; its log says why";
  }
  if (status.note.empty() && wanted_ == 0 && running_ + pending_ == 0) {
    status.note = "all jobs were cancelled; sbatch the script again, or end this run";
  }
  return status;
}

}  // namespace swarmsmith
