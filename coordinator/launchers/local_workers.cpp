#include "coordinator/launchers/local_workers.h"

#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <csignal>
#include <random>
#include <utility>

#include "base/local_secret.h"
#include "base/usable_processors.h"
#include "coordinator/launchers/worker_program.h"

namespace swarmsmith {
namespace {

constexpr Duration kShortLife = std::chrono::seconds(5);
constexpr Duration kFirstPause = std::chrono::milliseconds(100);
constexpr Duration kLongestPause = std::chrono::seconds(10);
constexpr Duration kEndGrace = std::chrono::seconds(2);
/// Of the same worker, in a row.
constexpr int kMostFailures = 5;
/// The exit codes of swarmsmith-worker if it cannot work here (WorkerExit).
constexpr int kRefused = 7;
constexpr int kNoPlace = 8;

}  // namespace

Expected<LocalWorkers> LocalWorkers::start(const LocalWorkersOptions& options) {
  LocalWorkers workers;
  std::filesystem::path program = options.program;
  if (program.empty()) {
    Expected<std::filesystem::path> found = find_worker_program();
    if (!found) return Unexpected(found.error());
    program = std::move(*found);
  }
  const int processes = std::max(1, options.processes);
  const int slots =
      options.slots > 0 ? options.slots : std::max(1, usable_processors() / processes);
  workers.command_ = {program.string(),    "--connect", options.endpoint,
                      "--die-with-parent", "--parent",  std::to_string(getpid())};
  workers.command_.insert(workers.command_.end(), options.arguments.begin(),
                          options.arguments.end());
  if (!options.secret.empty()) {
    workers.variables_.push_back(std::string(kLocalSecret) + "=" + options.secret);
  }
  workers.wanted_ = processes;
  std::random_device device;
  for (int i = 0; i < processes; ++i) {
    workers.workers_.push_back({.process = {},
                                .slots = slots + (i < options.more ? 1 : 0),
                                .backoff = Backoff(kFirstPause, kLongestPause, Rng(device()))});
    const auto launched = workers.launch(workers.workers_.back(), SystemClock().now());
    if (!launched) return Unexpected(launched.error());
  }
  return workers;
}

LocalWorkers::~LocalWorkers() {
  stop(kEndGrace);
}

/// The worker itself asks the kernel to kill it with its parent, and then checks that its parent is
/// still the process that started it, so it can never be orphaned. For the kernel, the parent is a
/// *thread*, so all workers must be started by one thread.
Expected<void> LocalWorkers::launch(Worker& worker, TimePoint now) {
  std::vector<std::string> command = command_;
  command.insert(command.end(), {"--slots", std::to_string(worker.slots)});
  const auto started = worker.process.start(command, ChildProcess::Streams::Inherited, variables_);
  if (!started) {
    return unexpected(ErrorKind::Unavailable, "a worker " + started.error().message,
                      started.error().where);
  }
  worker.started = now;
  return {};
}

void LocalWorkers::on_ended(Worker& worker, int status, TimePoint now) {
  const int exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (exit_code == kRefused || exit_code == kNoPlace) {
    trouble_ = "the coordinator's own workers were refused (" + command_.front() + ", exit code " +
               std::to_string(exit_code) + "); the worker's last line says why";
  }
  const bool lived = now - worker.started >= kShortLife;
  // A worker that is killed had an accident; one that keeps ending without a signal has failed,
  // with whatever exit code: a worker exits normally only when it is asked to.
  const bool failed = WIFEXITED(status) && !lived;
  worker.failures = failed ? worker.failures + 1 : 0;
  if (worker.failures >= kMostFailures && trouble_.empty()) {
    trouble_ =
        "workers end as soon as they are started (" + command_.front() + ", exit code " +
        std::to_string(exit_code) + "); " +
        (exit_code == 0 ? "is it swarmsmith-worker?" : "install it again, or read its output");
  }
  if (lived) worker.backoff.reset();
  worker.start_at = lived ? now : now + worker.backoff.next();
}

std::string LocalWorkers::tend(TimePoint now) {
  for (Worker& worker : workers_) {
    if (const auto status = worker.process.ended()) on_ended(worker, *status, now);
    if (worker.process.runs() || now < worker.start_at || !trouble_.empty()) continue;
    if (const Expected<void> launched = launch(worker, now); !launched) {
      trouble_ = to_string(launched.error());
    }
  }
  return trouble_;
}

std::string LocalWorkers::stop(Duration grace) {
  for (const Worker& worker : workers_)
    worker.process.signal(SIGTERM);
  const TimePoint until = SystemClock().now() + grace;
  for (Worker& worker : workers_)
    worker.process.finish_by(until);
  workers_.clear();
  return {};
}

LauncherStatus LocalWorkers::status() const {
  LauncherStatus status{.name = "local", .wanted = wanted_};
  status.running = static_cast<std::int64_t>(pids().size());
  status.pending = wanted_ - status.running;
  return status;
}

std::vector<pid_t> LocalWorkers::pids() const {
  std::vector<pid_t> pids;
  for (const Worker& worker : workers_) {
    if (worker.process.runs()) pids.push_back(worker.process.pid());
  }
  return pids;
}

}  // namespace swarmsmith
