#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/clock.h"
#include "base/process/child_process.h"
#include "coordinator/launchers/launcher.h"

namespace swarmsmith {

/// One job as squeue lists it.
struct QueuedJob {
  std::string id;      ///< "12_3" for an element of an array
  std::string state;   ///< "PENDING", "RUNNING", "CANCELLED", ...
  std::string reason;  ///< "Resources", "Priority", "None", ...

  friend bool operator==(const QueuedJob&, const QueuedJob&) = default;
};

/// Lines "id|state|reason" (squeue --format="%i|%T|%r"); others are left out.
std::vector<QueuedJob> parse_queue(std::string_view text);

struct SlurmTimes {
  /// Between two looks at the queue: growing while nothing changes there.
  Duration first_poll = std::chrono::seconds(5);
  Duration longest_poll = std::chrono::minutes(1);
  /// Between two submissions: doubling while jobs have to be replaced again and again.
  Duration first_pause = std::chrono::seconds(10);
  Duration longest_pause = std::chrono::minutes(10);
};

/// Decides when to look at Slurm's queue and how many jobs to submit. Pure: what Slurm said comes
/// in with the time, the next thing to do comes out.
///
/// Nothing is submitted but on a fresh view of the queue: so jobs of an earlier coordinator of the
/// same campaign are found and counted, and a submission whose answer got lost is not made twice.
/// A job that ended while work is left is replaced, except when a person cancelled it: who
/// does that wants fewer workers. Workers end well only when they are asked to: if jobs complete as
/// soon as they run, again and again, their program is none. Jobs that a person submitted by hand
/// under the same name count.
class SlurmJobs {
 public:
  SlurmJobs(std::int64_t wanted, SlurmTimes times, Rng jitter);

  struct Nothing {};
  struct LookAtQueue {};
  struct Submit {
    std::int64_t jobs;
  };
  using Action = std::variant<Nothing, LookAtQueue, Submit>;
  /// What to do now. After LookAtQueue and Submit: nothing until the answer was told.
  Action next(TimePoint now);

  void on_queue(const std::vector<QueuedJob>& jobs, TimePoint now);
  /// squeue failed and said this.
  void on_no_queue(const std::string& message, TimePoint now);
  void on_submitted(std::int64_t jobs, TimePoint now);
  /// sbatch failed and said this.
  void on_refused(const std::string& message, TimePoint now);

  /// Why there can be no workers at all: Slurm refused the very first jobs, or they do nothing.
  /// Empty otherwise.
  const std::string& trouble() const { return trouble_; }
  LauncherStatus status() const;

 private:
  void count(const std::vector<QueuedJob>& jobs, TimePoint now);
  void note_life(const std::vector<QueuedJob>& jobs, TimePoint now);
  void plan(TimePoint now);

  std::int64_t wanted_;
  SlurmTimes times_;
  Backoff pause_;
  std::map<std::string, std::string> states_;       ///< of each job when last seen
  std::map<std::string, TimePoint> running_since_;  ///< of those that run, as far as was seen
  int quick_ends_ = 0;                              ///< jobs that completed at once, in a row
  bool seen_ = false;                               ///< the queue was
  bool submitted_ = false;                          ///< jobs were, by this launcher or before it
  bool asked_ = false;                              ///< and no answer yet
  std::int64_t running_ = 0;
  std::int64_t pending_ = 0;
  std::int64_t leaving_ = 0;  ///< on their way out
  std::int64_t to_submit_ = 0;
  std::string waits_for_;
  std::string failed_job_;  ///< the last one that Slurm calls failed
  std::string queue_note_;
  std::string submit_note_;
  std::string trouble_;
  Duration poll_;
  TimePoint look_at_;
  TimePoint submit_at_;
  TimePoint last_submit_;
};

}  // namespace swarmsmith
