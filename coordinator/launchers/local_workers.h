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
  std::string endpoint;  ///< the coordinator's endpoint
  int processes = 1;
  int slots = 0;  ///< for each process; 0: the usable processors, shared among the processes
  int more = 0;   ///< so many processes have one slot more
  std::filesystem::path program;       ///< empty: the result of `find_worker_program`
  std::vector<std::string> arguments;  ///< additional arguments for the program
  std::string secret{};                ///< these workers show it to the coordinator, which then
                                       ///< recognises them; empty: none
};

/// Worker processes of this host. They die with this process, however it ends. A worker that ends
/// is started again, at once or, if it ran only for a short time, after a pause that grows.
class LocalWorkers final : public Launcher {
 public:
  static Expected<LocalWorkers> start(const LocalWorkersOptions& options);
  /// Ends the workers: first SIGTERM, then SIGKILL if they take too long.
  ~LocalWorkers() override;
  LocalWorkers(LocalWorkers&&) noexcept = default;

  /// Errors: the coordinator refused the workers, or the program does not start.
  std::string tend(TimePoint now) override;
  std::string stop(Duration grace) override;
  LauncherStatus status() const override;

  std::vector<pid_t> pids() const;

 private:
  struct Worker {
    ChildProcess process;
    int slots;
    TimePoint started;
    TimePoint start_at;
    Backoff backoff;
    int failures = 0;  ///< quick ends in a row, not by a signal but with any exit code
  };

  LocalWorkers() = default;
  Expected<void> launch(Worker& worker, TimePoint now);
  void on_ended(Worker& worker, int status, TimePoint now);

  std::vector<std::string> command_;
  std::vector<std::string> variables_;  ///< environment variables for the workers
  std::vector<Worker> workers_;
  std::int64_t wanted_ = 0;
  std::string trouble_;
};

}  // namespace swarmsmith
