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
  /// The same for each start of one campaign with one store, and for nothing else: by it a
  /// coordinator that was started again finds its jobs.
  std::string job_name;
  /// Where script and outputs go, made when it is not there; every node must see it, since Slurm
  /// writes the outputs there.
  std::filesystem::path folder;
  WorkerAddress address;
  std::filesystem::path program;       ///< on every node; empty: `find_worker_program`
  std::vector<std::string> arguments;  ///< more of them, for the worker
  /// In place of `program`, from the cache of this user, which every node must see; empty: none.
  std::vector<WorkerBundle> bundles{};
  SlurmTimes times;
};

/// The name of the jobs of a campaign (its digest) with this store.
std::string slurm_job_name(const std::string& campaign_digest, const std::filesystem::path& store);

/// Workers as jobs of Slurm: orchestration facts, 12. One job is one worker with many slots, never
/// one evaluation. Slurm's programs run in a thread of their own, one at a time: they may take as
/// long as they like. The queue is waited for without limit.
class SlurmWorkers final : public Launcher {
 public:
  /// Errors: NotFound (no sbatch here), Unavailable (the script cannot be written).
  static Expected<SlurmWorkers> start(SlurmWorkersOptions options);
  /// The jobs stay: only `stop` cancels them.
  ~SlurmWorkers() override;
  SlurmWorkers(SlurmWorkers&&) noexcept = default;

  /// Trouble: Slurm refused the first jobs (an unknown account or partition, too many CPUs).
  std::string tend(TimePoint now) override;
  /// Cancels all jobs of the campaign's name, those that a person has submitted too: they would
  /// wait for a coordinator that has ended.
  std::string stop(Duration grace) override;
  LauncherStatus status() const override;

 private:
  struct Answer {
    bool ok = false;
    std::string text;  ///< what it wrote, or why it failed
  };

  explicit SlurmWorkers(SlurmWorkersOptions options);
  void ask(std::vector<std::string> words);
  void take_answer(TimePoint now);

  SlurmWorkersOptions options_;
  SlurmJobs jobs_;
  std::unique_ptr<Interrupt> interrupt_ = std::make_unique<Interrupt>();
  std::future<Answer> answer_;   ///< of the program that runs
  std::int64_t submitting_ = 0;  ///< jobs, when that is sbatch
  bool stopped_ = false;
};

}  // namespace swarmsmith
