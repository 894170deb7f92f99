#include "coordinator/local_workers.h"

#include <poll.h>
#include <sched.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace swarmsmith {
namespace {

constexpr Duration kShortLife = std::chrono::seconds(5);
constexpr Duration kFirstPause = std::chrono::milliseconds(100);
constexpr Duration kLongestPause = std::chrono::seconds(10);
constexpr Duration kEndGrace = std::chrono::seconds(2);
/// Of one worker, in a row.
constexpr int kMostFailures = 5;
/// swarmsmith-worker's exit code for a coordinator that does not want it.
constexpr int kRefused = 7;

TimePoint now_of_system() {
  return SystemClock().now();
}

int available_cpus() {
  cpu_set_t mask;
  CPU_ZERO(&mask);
  return sched_getaffinity(0, sizeof mask, &mask) == 0 ? CPU_COUNT(&mask) : 1;
}

}  // namespace

std::vector<std::string> allow_arguments(const Target& target) {
  std::vector<std::string> arguments;
  for (const std::string& program : {target.runner, target.launcher, target.evaluator}) {
    if (program.empty()) continue;
    arguments.emplace_back("--allow");
    arguments.push_back(program);
  }
  arguments.emplace_back("--allow-shell");
  return arguments;
}

Expected<std::filesystem::path> find_worker_program() {
  std::filesystem::path program;
  if (const char* named = std::getenv("SWARMSMITH_WORKER"); named != nullptr && *named != '\0') {
    program = named;
  } else {
    std::error_code failed;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", failed);
    program = self.parent_path() / "swarmsmith-worker";
  }
  if (access(program.c_str(), X_OK) == 0) return program;
  return unexpected(ErrorKind::NotFound,
                    "no program to start workers with; install it beside this one, or name it in "
                    "SWARMSMITH_WORKER",
                    program.string());
}

Expected<LocalWorkers> LocalWorkers::start(const LocalWorkersOptions& options) {
  LocalWorkers workers;
  std::filesystem::path program = options.program;
  if (program.empty()) {
    Expected<std::filesystem::path> found = find_worker_program();
    if (!found) return Unexpected(found.error());
    program = std::move(*found);
  }
  const int processes = std::max(1, options.processes);
  const int slots = options.slots > 0 ? options.slots : std::max(1, available_cpus() / processes);
  workers.command_ = {
      program.string(),      "--connect",         options.endpoint, "--slots",
      std::to_string(slots), "--die-with-parent", "--parent",       std::to_string(getpid())};
  workers.command_.insert(workers.command_.end(), options.arguments.begin(),
                          options.arguments.end());
  workers.children_.resize(static_cast<std::size_t>(processes));
  for (Child& child : workers.children_) {
    const Expected<void> launched = workers.launch(child, now_of_system());
    if (!launched) return Unexpected(launched.error());
  }
  return workers;
}

LocalWorkers::LocalWorkers(LocalWorkers&& other) noexcept
    : command_(std::move(other.command_)),
      children_(std::exchange(other.children_, {})),
      trouble_(std::move(other.trouble_)) {}

LocalWorkers::~LocalWorkers() {
  stop(kEndGrace);
}

/// The worker itself asks to die with its parent, and checks that the parent is still the one that
/// it was told: so no moment is left in which it could be orphaned. Note that the kernel means the
/// parent *thread*, which is why one thread does all of this.
Expected<void> LocalWorkers::launch(Child& child, TimePoint now) {
  std::vector<char*> arguments;
  for (std::string& word : command_)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  // A group of its own: Ctrl-C at the terminal is for the coordinator, which then drains.
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  const int failed = posix_spawn(&child.pid, command_.front().c_str(), nullptr, &attributes,
                                 arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  if (failed != 0) {
    child.pid = 0;
    return unexpected(ErrorKind::Unavailable,
                      std::string("cannot start a worker: ") + std::strerror(failed),
                      command_.front());
  }
  child.started = now;
  return {};
}

void LocalWorkers::on_ended(Child& child, int status, TimePoint now) {
  child.pid = 0;
  if (WIFEXITED(status) && WEXITSTATUS(status) == kRefused) {
    trouble_ =
        "the coordinator refuses its own workers (" + command_.front() + " is of another build)";
  }
  const bool lived = now - child.started >= kShortLife;
  // Being killed is an accident; ending by oneself, again and again, is not.
  const bool failed = WIFEXITED(status) && WEXITSTATUS(status) != 0 && !lived;
  child.failures = failed ? child.failures + 1 : 0;
  if (child.failures >= kMostFailures && trouble_.empty()) {
    trouble_ = "workers end as soon as they are started (" + command_.front() + ", exit code " +
               std::to_string(WEXITSTATUS(status)) + "); install it again, or see what it says";
  }
  child.pause = lived ? Duration{} : std::clamp(2 * child.pause, kFirstPause, kLongestPause);
  child.start_at = now + child.pause;
}

std::string LocalWorkers::tend(TimePoint now) {
  for (Child& child : children_) {
    int status = 0;
    if (child.pid > 0 && waitpid(child.pid, &status, WNOHANG) == child.pid) {
      on_ended(child, status, now);
    }
    if (child.pid > 0 || now < child.start_at || !trouble_.empty()) continue;
    if (const Expected<void> launched = launch(child, now); !launched) {
      trouble_ = to_string(launched.error());
    }
  }
  return trouble_;
}

void LocalWorkers::stop(Duration grace) {
  for (const Child& child : children_) {
    if (child.pid > 0) kill(child.pid, SIGTERM);
  }
  const TimePoint until = now_of_system() + grace;
  for (Child& child : children_) {
    int status = 0;
    while (child.pid > 0 && now_of_system() < until) {
      if (waitpid(child.pid, &status, WNOHANG) == child.pid) {
        child.pid = 0;
      } else {
        poll(nullptr, 0, 5);
      }
    }
    if (child.pid > 0) {
      kill(child.pid, SIGKILL);
      waitpid(child.pid, &status, 0);
      child.pid = 0;
    }
  }
  children_.clear();
}

std::vector<pid_t> LocalWorkers::pids() const {
  std::vector<pid_t> pids;
  for (const Child& child : children_) {
    if (child.pid > 0) pids.push_back(child.pid);
  }
  return pids;
}

}  // namespace swarmsmith
