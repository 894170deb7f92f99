#pragma once

#include <filesystem>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "base/expected.h"
#include "base/process/interrupt.h"
#include "base/process/process.h"
#include "coordinator/launchers/launch_options.h"
#include "coordinator/launchers/launcher.h"
#include "coordinator/launchers/slurm_jobs.h"
#include "coordinator/launchers/worker_bundle.h"

namespace swarmsmith {

struct SlurmWorkersOptions {
  SlurmOptions slurm;
  /// The same in every run of one campaign with one store, and different for others: a restarted
  /// coordinator finds its jobs by this name.
  std::string job_name;
  /// The folder for the script and the jobs' outputs; created if missing. Every node must see it,
  /// since Slurm writes the outputs there.
  std::filesystem::path folder;
  WorkerAddress address;
  std::filesystem::path program;       ///< on every node; empty: the result of
                                       ///< `find_worker_program`
  std::vector<std::string> arguments;  ///< additional arguments for the worker
  /// Bundles to run instead of `program`, from this user's cache, visible to every node; empty:
  /// none.
  std::vector<WorkerBundle> bundles{};
  SlurmTimes times;
};

/// The name of the jobs of a campaign, made from its digest and its store.
std::string slurm_job_name(const std::string& campaign_digest, const std::filesystem::path& store);

/// Workers as Slurm jobs: orchestration facts, 12. One job is one worker with many slots, never one
/// evaluation. Slurm's commands run in a separate thread, one at a time, so a slow command does not
/// block. There is no limit on the time that jobs may wait in the queue.
class SlurmWorkers final : public Launcher {
 public:
  /// Errors: NotFound (no sbatch here), Unavailable (the script cannot be written).
  static Expected<SlurmWorkers> start(SlurmWorkersOptions options);
  /// The jobs keep running: only `stop` cancels them.
  ~SlurmWorkers() override;
  SlurmWorkers(SlurmWorkers&&) noexcept = default;

  /// Errors: Slurm refused the first jobs (an unknown account or partition, too many CPUs).
  std::string tend(TimePoint now) override;
  /// Cancels all jobs with the campaign's job name, including jobs that a person submitted: they
  /// would wait for a coordinator that has ended.
  std::string stop(Duration grace) override;
  LauncherStatus status() const override;

 private:
  struct Answer {
    bool ok = false;
    std::string text;  ///< the program's output, or why it failed
  };

  explicit SlurmWorkers(SlurmWorkersOptions options);
  void ask(std::vector<std::string> words);
  void take_answer(TimePoint now);

  SlurmWorkersOptions options_;
  SlurmJobs jobs_;
  std::unique_ptr<Interrupt> interrupt_ = std::make_unique<Interrupt>();
  std::future<Answer> answer_;   ///< of the program that is running
  std::int64_t submitting_ = 0;  ///< number of jobs, if that program is sbatch
  bool stopped_ = false;
};

}  // namespace swarmsmith
