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

/// A job in the format of squeue.
struct QueuedJob {
  std::string id;      ///< "12_3" for an element of an array
  std::string state;   ///< "PENDING", "RUNNING", "CANCELLED", ...
  std::string reason;  ///< "Resources", "Priority", "None", ...

  friend bool operator==(const QueuedJob&, const QueuedJob&) = default;
};

/// Parses lines "id|state|reason" (squeue --format="%i|%T|%r"); other lines are ignored.
std::vector<QueuedJob> parse_queue(std::string_view text);

struct SlurmTimes {
  /// Time between two queries of the queue; it grows while nothing changes there.
  Duration first_poll = std::chrono::seconds(5);
  Duration longest_poll = std::chrono::minutes(1);
  /// Time between two submissions; it doubles while jobs must be replaced again and again.
  Duration first_pause = std::chrono::seconds(10);
  Duration longest_pause = std::chrono::minutes(10);
};

/// Decides when to query Slurm's queue and how many jobs to submit. Pure: Slurm's answers and the
/// time come in, the next action comes out.
///
/// Jobs are submitted only after a fresh query of the queue. So jobs of an earlier coordinator of
/// the same campaign are found and counted, and a submission whose answer was lost is not repeated.
/// A job that ended while work is left is replaced, unless a person cancelled it: that person wants
/// fewer workers. A worker exits normally only when it is asked to: if several jobs in a row
/// complete as soon as they run, their program is not a worker. Jobs with the same name that a
/// person submitted by hand count too.
class SlurmJobs {
 public:
  SlurmJobs(std::int64_t wanted, SlurmTimes times, Rng jitter);

  struct Nothing {};
  struct LookAtQueue {};
  struct Submit {
    std::int64_t jobs;
  };
  using Action = std::variant<Nothing, LookAtQueue, Submit>;
  /// The next action. After LookAtQueue and Submit, it is Nothing until their answer has come.
  Action next(TimePoint now);

  void on_queue(const std::vector<QueuedJob>& jobs, TimePoint now);
  /// squeue failed with this message.
  void on_no_queue(const std::string& message, TimePoint now);
  void on_submitted(std::int64_t jobs, TimePoint now);
  /// sbatch failed with this message.
  void on_refused(const std::string& message, TimePoint now);

  /// The reason why there can be no workers at all: Slurm refused the very first jobs, or the jobs
  /// end at once. Empty otherwise.
  const std::string& trouble() const { return trouble_; }
  LauncherStatus status() const;

 private:
  void count(const std::vector<QueuedJob>& jobs, TimePoint now);
  void note_life(const std::vector<QueuedJob>& jobs, TimePoint now);
  void plan(TimePoint now);

  std::int64_t wanted_;
  SlurmTimes times_;
  Backoff pause_;
  std::map<std::string, std::string> states_;       ///< last known state of each job
  std::map<std::string, TimePoint> running_since_;  ///< when each job was first seen running
  int quick_ends_ = 0;                              ///< jobs that completed at once, in a row
  bool seen_ = false;                               ///< whether the queue has been read
  bool submitted_ = false;                          ///< whether jobs were submitted, by this
                                                    ///< launcher or an earlier one
  bool asked_ = false;                              ///< whether an answer is pending
  std::int64_t running_ = 0;
  std::int64_t pending_ = 0;
  std::int64_t leaving_ = 0;  ///< jobs that are completing
  std::int64_t to_submit_ = 0;
  std::string waits_for_;
  std::string failed_job_;  ///< the last job in a state that counts as failed
  std::string queue_note_;
  std::string submit_note_;
  std::string trouble_;
  Duration poll_;
  TimePoint look_at_;
  TimePoint submit_at_;
  TimePoint last_submit_;
};

}  // namespace swarmsmith
