#pragma once

#include <sys/types.h>
#include <filesystem>
#include <string>
#include <vector>

#include "base/clock.h"
#include "base/expected.h"
#include "target/target.h"

namespace swarmsmith {

struct LocalWorkersOptions {
  std::string endpoint;  ///< of the coordinator
  int processes = 1;
  int slots = 0;  ///< of each process; 0: as many as CPUs, shared among the processes
  std::filesystem::path program;       ///< empty: `find_worker_program`
  std::vector<std::string> arguments;  ///< more of them, for the program
};

/// Arguments that let a worker run a user's own programs, and a shell for their command lines.
std::vector<std::string> allow_arguments(const Target& target);

/// The program `swarmsmith-worker`: SWARMSMITH_WORKER names it, else it lies beside this program.
Expected<std::filesystem::path> find_worker_program();

/// Worker processes of this host. They die with this process whatever happens to it. One that ends
/// is started again, at once or, when it did not live long, after a growing pause.
class LocalWorkers {
 public:
  static Expected<LocalWorkers> start(const LocalWorkersOptions& options);
  /// Ends them: SIGTERM, and SIGKILL when that takes too long.
  ~LocalWorkers();
  LocalWorkers(LocalWorkers&& other) noexcept;
  LocalWorkers& operator=(LocalWorkers&&) = delete;

  /// Looks after them; several times a second, by the thread that made them. Returns why workers
  /// cannot be had, if so: they were refused, or the program does not start.
  std::string tend(TimePoint now);
  /// Asks them to drain and waits at most `grace`.
  void stop(Duration grace);

  std::vector<pid_t> pids() const;

 private:
  struct Child {
    pid_t pid = 0;  ///< 0 while none runs
    TimePoint started;
    TimePoint start_at;
    Duration pause{};
    int failures = 0;  ///< ended at once by itself, in a row
  };

  LocalWorkers() = default;
  Expected<void> launch(Child& child, TimePoint now);
  void on_ended(Child& child, int status, TimePoint now);

  std::vector<std::string> command_;
  std::vector<Child> children_;
  std::string trouble_;
};

}  // namespace swarmsmith
