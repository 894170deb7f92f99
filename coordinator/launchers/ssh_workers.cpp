#include "coordinator/launchers/ssh_workers.h"

#include <sys/wait.h>
#include <algorithm>
#include <csignal>
#include <random>
#include <utility>

#include "base/process/process.h"
#include "coordinator/launchers/worker_program.h"

namespace swarmsmith {
namespace {

/// A worker that ran so long did not fail at its start.
constexpr Duration kShortLife = std::chrono::seconds(30);
constexpr Duration kEndGrace = std::chrono::seconds(2);
constexpr int kRefused = 7;      // swarmsmith-worker: another build
constexpr int kNoProgram = 127;  // the shell of that host
constexpr int kSshFailed = 255;  // ssh itself

/// What an exit code of ssh means, for people.
std::string reason(int status, const std::string& said) {
  const std::string words = said.empty() ? "" : ": " + said;
  if (!WIFEXITED(status)) return "ssh was killed";
  switch (WEXITSTATUS(status)) {
    case 0:
      return "the worker was drained";
    case kRefused:
      return "the worker there and the coordinator are different builds; it is not started again";
    case kNoProgram:
      return "there is no such program there (`program=PATH` in the host file names it)" + words;
    case kSshFailed:
      return "cannot be reached" + words;
    default:
      return "the worker ended with code " + std::to_string(WEXITSTATUS(status)) + words;
  }
}

}  // namespace

std::vector<std::string> ssh_words(const SshWorkersOptions& options, const SshHost& host) {
  WorkerAddress address = options.address;
  if (!host.coordinator.empty()) address.coordinator = host.coordinator;
  if (!host.key.empty()) address.key = host.key;
  const auto& program = host.program.empty() ? options.program : host.program;
  std::vector<std::string> worker{program.string(), "--watch-input"};
  std::ranges::copy(address_arguments(address), std::back_inserter(worker));
  if (host.slots > 0) {
    worker.emplace_back("--slots");
    worker.push_back(std::to_string(host.slots));
  }
  std::ranges::copy(options.arguments, std::back_inserter(worker));
  // ssh takes the first of several values: the user's options win.
  std::vector<std::string> words{options.ssh};
  std::ranges::copy(options.options, std::back_inserter(words));
  for (const char* word : {"-T", "-a", "-x", "-o", "BatchMode=yes", "-o", "ConnectTimeout=10", "-o",
                           "ServerAliveInterval=5", "-o", "ServerAliveCountMax=3", "--"}) {
    words.emplace_back(word);
  }
  words.push_back(host.name);
  words.push_back("exec " + shell_line(worker));
  return words;
}

Expected<SshWorkers> SshWorkers::start(SshWorkersOptions options) {
  const auto ssh = find_program(options.ssh);
  if (!ssh) {
    return unexpected(ErrorKind::NotFound,
                      "ssh is not here; install the package openssh-client, or start workers "
                      "otherwise",
                      options.ssh);
  }
  if (options.program.empty()) {
    Expected<std::filesystem::path> found = find_worker_program();
    if (!found) return Unexpected(found.error());
    options.program = std::move(*found);
  }
  SshWorkers workers;
  workers.wanted_ = static_cast<std::int64_t>(options.hosts.size());
  std::random_device device;
  for (const SshHost& host : options.hosts) {
    workers.workers_.push_back(
        {.words = ssh_words(options, host),
         .host = host.name,
         .ssh = {},
         .backoff = Backoff(options.first_pause, options.longest_pause, Rng(device()))});
    workers.launch(workers.workers_.back(), SystemClock().now());
  }
  return workers;
}

SshWorkers::~SshWorkers() {
  stop(kEndGrace);
}

void SshWorkers::launch(Worker& worker, TimePoint now) {
  const auto started = worker.ssh.start(worker.words, ChildProcess::Streams::Held);
  worker.started = now;
  if (started) return;
  worker.trouble = to_string(started.error());
  worker.start_at = now + worker.backoff.next();
}

void SshWorkers::on_ended(Worker& worker, int status, TimePoint now) {
  worker.trouble = reason(status, worker.ssh.last_line());
  worker.refused = WIFEXITED(status) && WEXITSTATUS(status) == kRefused;
  if (now - worker.started >= kShortLife) worker.backoff.reset();
  worker.start_at = now + worker.backoff.next();
}

std::string SshWorkers::tend(TimePoint now) {
  for (Worker& worker : workers_) {
    worker.ssh.last_line();  // takes what it says, so that it can go on
    if (const auto status = worker.ssh.ended()) on_ended(worker, *status, now);
    if (worker.ssh.runs()) {
      if (now - worker.started >= kShortLife) worker.trouble.clear();
      continue;
    }
    if (!worker.refused && now >= worker.start_at) launch(worker, now);
  }
  const bool none_left = !workers_.empty() && std::ranges::all_of(workers_, &Worker::refused);
  return none_left ? "ssh: " + workers_.front().host + ": " + workers_.front().trouble : "";
}

std::string SshWorkers::stop(Duration grace) {
  for (Worker& worker : workers_)
    worker.ssh.end_input();
  const TimePoint until = SystemClock().now() + grace;
  for (Worker& worker : workers_)
    worker.ssh.finish_by(until);
  workers_.clear();
  return {};
}

LauncherStatus SshWorkers::status() const {
  LauncherStatus status{.name = "ssh", .wanted = wanted_};
  std::int64_t others = 0;
  for (const Worker& worker : workers_) {
    if (worker.ssh.runs()) {
      ++status.running;
    } else {
      ++status.pending;
    }
    if (worker.trouble.empty()) continue;
    if (status.note.empty()) {
      status.note = worker.host + ": " + worker.trouble;
    } else {
      ++others;
    }
  }
  if (others > 0) status.note += " (and " + std::to_string(others) + " more hosts)";
  return status;
}

}  // namespace swarmsmith
