#pragma once

#include <sys/types.h>
#include <filesystem>
#include <string>
#include <vector>

#include "base/clock.h"
#include "base/expected.h"
#include "base/process/child_process.h"
#include "coordinator/launchers/launcher.h"

namespace swarmsmith {

struct LocalWorkersOptions {
  std::string endpoint;  ///< of the coordinator
  int processes = 1;
  int slots = 0;  ///< of each process; 0: as many as usable processors, shared among them
  std::filesystem::path program;       ///< empty: `find_worker_program`
  std::vector<std::string> arguments;  ///< more of them, for the program
  std::string secret{};                ///< by which the coordinator knows them; empty for none
};

/// Worker processes of this host. They die with this process whatever happens to it. One that ends
/// is started again, at once or, when it did not live long, after a growing pause.
class LocalWorkers final : public Launcher {
 public:
  static Expected<LocalWorkers> start(const LocalWorkersOptions& options);
  /// Ends them: SIGTERM, and SIGKILL when that takes too long.
  ~LocalWorkers() override;
  LocalWorkers(LocalWorkers&&) noexcept = default;

  /// Trouble: they were refused, or the program does not start.
  std::string tend(TimePoint now) override;
  std::string stop(Duration grace) override;
  LauncherStatus status() const override;

  std::vector<pid_t> pids() const;

 private:
  struct Worker {
    ChildProcess process;
    TimePoint started;
    TimePoint start_at;
    Backoff backoff;
    int failures = 0;  ///< ended at once by itself, well or not, in a row
  };

  LocalWorkers() = default;
  Expected<void> launch(Worker& worker, TimePoint now);
  void on_ended(Worker& worker, int status, TimePoint now);

  std::vector<std::string> command_;
  std::vector<std::string> variables_;  ///< of their environment
  std::vector<Worker> workers_;
  std::int64_t wanted_ = 0;
  std::string trouble_;
};

}  // namespace swarmsmith
