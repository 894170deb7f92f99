#include "coordinator/launchers/ssh_workers.h"

#include <sys/wait.h>
#include <algorithm>
#include <csignal>
#include <random>
#include <utility>

#include "base/process/process.h"
#include "base/worker_words.h"
#include "coordinator/launchers/worker_program.h"

namespace swarmsmith {
namespace {

/// A worker that ran at least this long did not fail at its start.
constexpr Duration kShortConnection = std::chrono::seconds(30);
constexpr Duration kFarewell = std::chrono::seconds(2);
/// Quick ends of one worker without an error, in a row.
constexpr int kMostShortConnections = 5;
/// Limits on simultaneous logins: the value at first and after a failed login, and the largest
/// value. Each successful login raises the limit by one. By default, sshd starts to reject
/// connections at 10.
constexpr int kFewLogins = 3;
constexpr int kMostLogins = 9;
/// A login that takes longer, because the host does not answer, no longer counts as under way.
constexpr Duration kLoginTime = std::chrono::seconds(12);
constexpr int kWorkerRefused = 7;  // of swarmsmith-worker, as the next one (WorkerExit)
constexpr int kFindsNoPlace = 8;   // as many workers as there may be, or quarantine
constexpr int kCannotRun = 126;    // of the host's shell: the program cannot be executed
constexpr int kNoProgram = 127;    // of the host's shell: there is no such program
constexpr int kSshFailed = 255;    // of ssh itself

bool is_sent_to(const SshWorkersOptions& options, const SshHost& host) {
  return !options.bundles.empty() && host.program.empty();
}

/// The command line of ssh to a host, with more options, up to the command.
std::vector<std::string> words_to(const SshWorkersOptions& options, const SshHost& host,
                                  const std::vector<std::string>& more) {
  // ssh uses the first of several values, so the user's options have priority.
  std::vector<std::string> words{options.ssh};
  std::ranges::copy(options.options, std::back_inserter(words));
  // Without a terminal (see the class), without a question for a password. ssh gives up after 3
  // times 5 s of silence (docs/cluster.md, "A handful of hosts: ssh").
  for (const char* word : {"-T", "-a", "-x", "-o", "BatchMode=yes", "-o", "ConnectTimeout=10", "-o",
                           "ServerAliveInterval=5", "-o", "ServerAliveCountMax=3"}) {
    words.emplace_back(word);
  }
  std::ranges::copy(more, std::back_inserter(words));
  words.emplace_back("--");
  words.push_back(host.name);
  return words;
}

/// The meaning of ssh's exit code, for people. `sent`: the worker came from a bundle.
std::string reason(int status, const std::string& said, bool sent) {
  const std::string words = said.empty() ? "" : ": " + said;
  if (!WIFEXITED(status)) return "ssh was killed";
  switch (WEXITSTATUS(status)) {
    case 0:
      return "the worker was drained";
    case kWorkerRefused:
      return "the worker there was refused, and is not started again" + words;
    case kFindsNoPlace:
      return "the coordinator has no place for the worker there" + words;
    case kCannotRun:
      if (!sent) break;
      return "the worker cannot be run there; if its folder is mounted noexec, set XDG_CACHE_HOME "
             "there" +
             words;
    case kNoProgram:
      if (sent) break;
      return "there is no such program there (`program=PATH` in the host file names it)" + words;
    case kSshFailed:
      return "cannot be reached" + words;
    default:
      break;
  }
  return "the worker ended with code " + std::to_string(WEXITSTATUS(status)) + words;
}

}  // namespace

std::vector<std::string> ssh_words(const SshWorkersOptions& options, const SshHost& host) {
  WorkerAddress address = options.address;
  if (!host.coordinator.empty()) address.coordinator = host.coordinator;
  if (!host.key.empty()) address.key = host.key;
  std::vector<std::string> worker{"--watch-input"};
  std::ranges::copy(address_arguments(address), std::back_inserter(worker));
  if (host.slots > 0) {
    worker.emplace_back("--slots");
    worker.push_back(std::to_string(host.slots));
  }
  std::ranges::copy(options.arguments, std::back_inserter(worker));
  if (is_sent_to(options, host)) {
    worker = start_words(options.bundles, {}, worker);
  } else {
    const auto& program = host.program.empty() ? options.program : host.program;
    worker.insert(worker.begin(), program.string());
  }
  std::vector<std::string> words = words_to(options, host, {});
  words.push_back(std::string("echo ") + kWorkerBegins + "; exec " + shell_line(worker));
  return words;
}

SshWorkers::SshWorkers(SshWorkersOptions options)
    : options_(std::move(options)), most_logins_(kFewLogins) {}

Expected<SshWorkers> SshWorkers::start(SshWorkersOptions options) {
  const auto ssh = find_program(options.ssh);
  if (!ssh) {
    return unexpected(
        ErrorKind::NotFound,
        "ssh is not installed; install the package openssh-client, or start workers in another way",
        options.ssh);
  }
  const bool all_sent = std::ranges::all_of(
      options.hosts, [&](const SshHost& host) { return is_sent_to(options, host); });
  if (options.program.empty() && !all_sent) {
    Expected<std::filesystem::path> found = find_worker_program();
    if (!found) return Unexpected(found.error());
    options.program = std::move(*found);
  }
  SshWorkers workers(std::move(options));
  std::random_device device;
  const TimePoint now = SystemClock().now();
  for (const SshHost& host : workers.options_.hosts) {
    workers.workers_.push_back({.host = host,
                                .ssh = {},
                                .start_at = now,
                                .backoff = Backoff(workers.options_.first_pause,
                                                   workers.options_.longest_pause, Rng(device()))});
  }
  workers.tend(now);
  return workers;
}

SshWorkers::~SshWorkers() {
  stop(kFarewell);
}

void SshWorkers::launch(Worker& worker, TimePoint now) {
  std::vector<std::string> words = ssh_words(options_, worker.host);
  if (worker.sends != nullptr) {
    words = {"/bin/sh", "-c", send_line(*worker.sends, words_to(options_, worker.host, {"-C"}))};
  }
  const auto started = worker.ssh.start(words, ChildProcess::Streams::Held);
  worker.started = now;
  worker.begun = worker.connected = false;
  worker.said.clear();
  if (started) return;
  worker.trouble = to_string(started.error());
  worker.sends = nullptr;
  worker.start_at = now + worker.backoff.next();
}

bool SshWorkers::may_launch(TimePoint now) const {
  return std::ranges::count_if(workers_, [&](const Worker& worker) {
           return worker.ssh.runs() && !worker.begun && now - worker.started < kLoginTime;
         }) < most_logins_;
}

void SshWorkers::hear(Worker& worker) {
  for (std::string& line : worker.ssh.take_lines()) {
    if (line == kWorkerBegins) {
      worker.begun = true;
      most_logins_ = std::min(most_logins_ + 1, kMostLogins);
    } else if (line == kWorkerConnected || line == kWorkerAlone) {
      worker.connected = line == kWorkerConnected;
    } else {
      worker.said = std::move(line);
    }
  }
}

bool SshWorkers::is_sent_now(const WorkerBundle* bundle) const {
  return std::ranges::any_of(workers_,
                             [bundle](const Worker& worker) { return worker.sends == bundle; });
}

void SshWorkers::on_sent(Worker& worker, bool well, TimePoint now) {
  const WorkerBundle* bundle = std::exchange(worker.sends, nullptr);
  worker.sent = well;
  if (well) {
    sent_.try_emplace(bundle, now);
    worker.trouble.clear();
    worker.start_at = now;
  } else {
    worker.trouble = "the worker cannot be sent there: " + worker.said;
    worker.start_at = now + worker.backoff.next();
  }
}

void SshWorkers::on_lacking(Worker& worker, const WorkerBundle& bundle, TimePoint now) {
  if (std::exchange(worker.sent, false)) {
    worker.trouble = "the worker was sent there, but cannot be found: " + worker.said;
    worker.start_at = now + worker.backoff.next();
    return;
  }
  worker.start_at = now;
  const auto sent = sent_.find(&bundle);
  // Checked before the bundle reached another host, which may share the cache: check again.
  if (sent != sent_.end() && worker.started < sent->second) return;
  worker.trouble = "the worker is sent there";
  const bool wait = sent == sent_.end() && is_sent_now(&bundle);
  (wait ? worker.after : worker.sends) = &bundle;
}

void SshWorkers::on_ended(Worker& worker, int status, TimePoint now) {
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  const bool ships = is_sent_to(options_, worker.host);
  if (worker.sends != nullptr) return on_sent(worker, code == 0, now);
  const int place = code - kNotInCache;
  if (ships && place >= 0 && place < std::ssize(options_.bundles))
    return on_lacking(worker, options_.bundles[static_cast<std::size_t>(place)], now);
  if (ships && code == kNoBundle) {
    worker.trouble = "there is no bundle for its architecture in " +
                     options_.bundles.front().archive.parent_path().string() +
                     " (`./dev bundle`): " + worker.said;
    worker.refused = true;
    return;
  }
  // An sshd may be refusing connections because too many arrive at once (docs/cluster.md, "A
  // handful of hosts: ssh").
  if (!worker.begun) most_logins_ = kFewLogins;
  worker.trouble = reason(status, worker.said, ships);
  worker.refused = code == kWorkerRefused;
  // A worker exits normally only when it is asked to.
  const bool quick = code == 0 && now - worker.started < kShortConnection;
  worker.quick_ends = quick ? worker.quick_ends + 1 : 0;
  if (worker.quick_ends >= kMostShortConnections) {
    worker.trouble =
        "the worker there ends as soon as it is started, with code 0; is it "
        "swarmsmith-worker? It is not started again";
    worker.refused = true;
  }
  if (now - worker.started >= kShortConnection) worker.backoff.reset();
  worker.start_at = now + worker.backoff.next();
}

std::string SshWorkers::tend(TimePoint now) {
  for (Worker& worker : workers_) {
    hear(worker);  // reads its output, so that it does not block
    if (const auto status = worker.ssh.ended()) {
      hear(worker);
      worker.connected = false;
      on_ended(worker, *status, now);
    }
    if (worker.ssh.runs()) {
      const bool is_late = worker.sends == nullptr && now - worker.started >= kShortConnection;
      if (worker.connected) {
        worker.trouble.clear();
      } else if (is_late) {
        worker.trouble = "the worker runs there, but is not connected" +
                         (worker.said.empty() ? "" : ": " + worker.said);
      }
      continue;
    }
    if (worker.refused || now < worker.start_at) continue;
    if (worker.after != nullptr && is_sent_now(worker.after)) continue;
    if (!may_launch(now)) continue;
    if (std::exchange(worker.after, nullptr) != nullptr) worker.trouble.clear();
    launch(worker, now);
  }
  const bool none_left = !workers_.empty() && std::ranges::all_of(workers_, &Worker::refused);
  return none_left ? "ssh: " + workers_.front().host.name + ": " + workers_.front().trouble : "";
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
  LauncherStatus status{.name = "ssh", .wanted = std::ssize(options_.hosts)};
  std::int64_t others = 0;
  for (const Worker& worker : workers_) {
    if (worker.connected) {
      ++status.running;
    } else {
      ++status.pending;
    }
    if (worker.trouble.empty()) continue;
    if (status.note.empty()) {
      status.note = worker.host.name + ": " + worker.trouble;
    } else {
      ++others;
    }
  }
  if (others > 0) status.note += " (and " + std::to_string(others) + " more hosts)";
  return status;
}

}  // namespace swarmsmith
