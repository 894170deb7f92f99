// swarmsmith-worker: evaluates tasks for one coordinator until it is drained.

#include <sys/prctl.h>
#include <unistd.h>
#include <CLI/CLI.hpp>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <span>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "base/assert.h"
#include "base/local_secret.h"
#include "base/log.h"
#include "base/plain_text.h"
#include "base/process/begin_program.h"
#include "base/process/guard.h"
#include "base/process_limits.h"
#include "base/shown_text.h"
#include "base/worker_words.h"
#include "console/complete.h"
#include "console/declared.h"
#include "proto/access/address.h"
#include "proto/access/find_coordinator.h"
#include "sim/engine/self_test.h"
#include "sim/engine/simulate.h"
#include "worker/evaluate.h"
#include "worker/referee.h"
#include "worker/service.h"
#include "worker/slots.h"

namespace swarmsmith {
namespace {

// The only data that signal handlers use.
std::atomic<bool> g_drain{false};
std::atomic<bool> g_interrupted{false};
std::atomic<bool> g_out_of_time{false};
Wakeup* g_wakeup = nullptr;

void on_signal(int) {
  // Not `g_drain`, which the end of the input and the processor's limit set, too: after them, too,
  // the first signal lets the worker return its tasks.
  if (g_interrupted.exchange(true)) std::_Exit(static_cast<int>(WorkerExit::Interrupted));
  g_drain = true;
  if (g_wakeup != nullptr) g_wakeup->notify();
}

/// Called again after each further second of processor time.
void on_processor_limit(int) {
  g_out_of_time = true;
  g_drain = true;
  if (g_wakeup != nullptr) g_wakeup->notify();
}

void handle_signals(Wakeup& wakeup) {
  g_wakeup = &wakeup;
  struct sigaction action = {};
  action.sa_handler = on_signal;
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGINT, &action, nullptr);
  action.sa_handler = on_processor_limit;
  sigaction(SIGXCPU, &action, nullptr);
}

/// The parent may have died before the kernel got this request: then the parent is another process.
void die_with_parent(pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (parent > 0 && getppid() != parent) std::_Exit(static_cast<int>(WorkerExit::Interrupted));
}

struct Arguments {
  std::string connect;
  std::string coordinator;
  std::string key;
  bool insecure_plaintext = false;
  int slots = 0;
  bool die_with_parent = false;
  pid_t parent = 0;
  bool watch_input = false;
  std::vector<std::string> allow;
  bool allow_shell = false;
  bool referee = false;
};

/// Drains when standard input ends. A separate thread waits for that and does nothing else, so that
/// a signal that ends the process is not delayed.
void watch_input() {
  SWARMSMITH_ASSERT(g_wakeup != nullptr, "signals are handled before the input is watched");
  // The launcher's end may close first: a write must not kill this process before it drains.
  std::signal(SIGPIPE, SIG_IGN);
  std::thread([] {
    std::array<char, 256> ignored{};
    ssize_t size = 0;
    do {
      size = read(STDIN_FILENO, ignored.data(), ignored.size());
    } while (size > 0 || (size < 0 && errno == EINTR));
    g_drain = true;
    g_wakeup->notify();
  }).detach();
}

Expected<AllowedPrograms> allowed_programs(const Arguments& arguments) {
  AllowedPrograms allowed;
  allowed.shell = arguments.allow_shell;
  for (const std::string& path : arguments.allow) {
    Expected<std::string> program = allowed_program(path);
    if (!program) return Unexpected(program.error());
    allowed.programs.push_back(std::move(*program));
  }
  if (allowed.programs.empty()) return allowed;
  if (auto started = start_guard(); !started) return Unexpected(started.error());
  return allowed;
}

int fail(const Error& error) {
  log_event(LogLevel::Error, "worker", "failed", {{"reason", to_string(error)}});
  return static_cast<int>(WorkerExit::Usage);
}

/// Checks the resources needed by the socket, the simulator and each slot.
Expected<void> check_limits(const Arguments& arguments, int slots) {
  constexpr std::int64_t kDescriptors = 24;
  constexpr std::int64_t kDescriptorsOfProgram = 4;
  // Measured values; a thread's stack alone takes 8 MiB of address space.
  constexpr std::uint64_t kSpace = std::uint64_t{96} << 20U;
  constexpr std::uint64_t kSpaceOfSlot = std::uint64_t{12} << 20U;
  constexpr std::uint64_t kMemory = std::uint64_t{16} << 20U;
  constexpr std::uint64_t kMemoryOfSlot = std::uint64_t{1} << 20U;
  const std::string who = "a worker with " + counted(slots, "slot");
  const bool programs = !arguments.allow.empty() || arguments.allow_shell;
  const std::int64_t descriptors = kDescriptors + (programs ? kDescriptorsOfProgram * slots : 0);
  if (auto enough = provide_descriptors(descriptors, descriptors, who); !enough) return enough;
  const auto number = static_cast<std::uint64_t>(slots);
  return check_memory(kSpace + number * kSpaceOfSlot, kMemory + number * kMemoryOfSlot, who);
}

void tell_launcher(bool connected) {
  std::cout << (connected ? kWorkerConnected : kWorkerAlone) << '\n' << std::flush;
}

/// How to find the coordinator; used again before each attempt to connect. Problems that a person
/// must solve are reported at once; if the coordinator's file does not exist yet, the worker waits
/// for it.
Expected<WorkerServiceOptions> service_options(const Arguments& arguments) {
  const CoordinatorSearch search{.endpoint = arguments.connect,
                                 .file = arguments.coordinator,
                                 .key = arguments.key,
                                 .role = "worker",
                                 .insecure_plaintext = arguments.insecure_plaintext};
  const auto find = [search]() -> Expected<CoordinatorAddress> {
    Expected<FoundCoordinator> found = find_coordinator(search);
    if (!found) return Unexpected(found.error());
    return CoordinatorAddress{found->endpoint, std::move(found->keys), std::move(found->others)};
  };
  const auto first = find();
  if (!first && first.error().kind != ErrorKind::NotFound) return Unexpected(first.error());
  return WorkerServiceOptions{
      .endpoint = arguments.connect.empty() ? arguments.coordinator : arguments.connect,
      .find = find,
      .on_connected = arguments.watch_input ? tell_launcher : nullptr,
      .protocol = {},
      .socket = {}};
}

int run(const Arguments& arguments) {
  if (arguments.die_with_parent) die_with_parent(arguments.parent);
  if (arguments.referee) {
    return serve_as_referee({.engine_version = kEngineVersion, .self_test = self_test_digest()},
                            make_evaluators(), STDIN_FILENO, STDOUT_FILENO);
  }
  const int slots = arguments.slots > 0 ? arguments.slots : available_slots();
  if (const auto enough = check_limits(arguments, slots); !enough) return fail(enough.error());
  WorkerIdentity identity = identity_of_this_process(slots, SWARMSMITH_VERSION);
  identity.engine_version = kEngineVersion;
  identity.self_test = self_test_digest();
  if (const char* secret = std::getenv(kLocalSecret)) identity.secret = secret;
  Expected<AllowedPrograms> allowed = allowed_programs(arguments);
  if (!allowed) return fail(allowed.error());
  const Expected<WorkerServiceOptions> options = service_options(arguments);
  if (!options) return fail(options.error());
  Wakeup wakeup;
  handle_signals(wakeup);
  change_log_level_by_signals();
  if (arguments.watch_input) watch_input();
  Pool pool(slots, make_evaluators(std::move(*allowed)), [&wakeup] { wakeup.notify(); });
  log_event(LogLevel::Debug, "worker", "started",
            {{"coordinator", arguments.connect.empty() ? arguments.coordinator : arguments.connect},
             {"slots", std::to_string(slots)}});
  const WorkerEnd end = serve(*options, identity, pool, wakeup, g_drain);
  const LogLevel level = end.code == WorkerExit::Done ? LogLevel::Debug : LogLevel::Error;
  log_event(level, "worker", "ended", {{"reason", end.reason}});
  if (g_out_of_time) {
    log_event(LogLevel::Error, "worker", "stopped",
              {{"reason", "this process has used the processor time that it may use (ulimit -t)"}});
    std::_Exit(128 + SIGXCPU);
  }
  // Slots that are still running have exceeded the grace time; their results are dropped.
  std::_Exit(static_cast<int>(end.code));
}

/// Answers requests of scripts, like swarmsmith itself (console/program.h); false if none.
bool answer_scripts(const CLI::App& app, std::span<const std::string> words) {
  if (words.empty()) return false;
  const std::vector<DeclaredOption> options = declared_options(app);
  if (words.front() == "--declared") {
    const auto alone = [&](const CLI::App*) {
      return JsonObject()
          .add("name", "")
          .add("summary", "")
          .add("details", "")
          .add("another_program", false)
          .add("options", declared_json(options));
    };
    std::cout << JsonObject()
                     .add("program", app.get_name())
                     .add("purpose", app.get_description())
                     .add("begin", "")
                     .add("commands", json_list(std::array{&app}, alone))
                     .text()
              << '\n';
    return true;
  }
  if (words.front() != "--complete") return false;
  std::vector<std::string> typed = typed_words(words.subspan(1));
  const std::string begin = typed.back();
  typed.pop_back();
  write_offer(std::cout, offer_next(options, typed, begin, nullptr), begin);
  return true;
}

int run_command_line(int argc, char** argv) {
  Arguments arguments;
  CLI::App app{
      "Evaluates control software for the coordinator of a campaign.\n"
      "Exit codes: 0 drained, 2 usage, 5 no coordinator for ten minutes, 7 refused by the "
      "coordinator\n(another build), 8 no place for it, 143 interrupted twice. SIGTERM drains."};
  app.name("swarmsmith-worker");
  CLI::Option_group* where = app.add_option_group("Address of the coordinator, one of");
  where->add_option("--connect", arguments.connect, "Address of the coordinator")
      ->type_name("HOST:PORT");
  where
      ->add_option("--coordinator", arguments.coordinator,
                   "File that the coordinator writes (STORE.coordinator); read again before each "
                   "try to connect, so it finds a coordinator that has moved")
      ->type_name("FILE");
  where
      ->add_flag("--referee", arguments.referee,
                 "Evaluate for the coordinator that started this process, through its standard "
                 "input and output")
      ->group("");
  where->require_option(1);
  app.add_option("--key", arguments.key,
                 "Key file, if the coordinator needs one (default: SWARMSMITH_KEY, else worker.key "
                 "in SWARMSMITH_KEYS or ~/.config/swarmsmith/keys)")
      ->type_name("FILE");
  app.add_flag("--insecure-plaintext", arguments.insecure_plaintext,
               "Connect to a coordinator on another host without encryption");
  app.add_option(
         "--slots", arguments.slots,
         "Parallel evaluations (default: SLURM_CPUS_PER_TASK, else the CPUs that this process "
         "may use)")
      ->type_name("N")
      ->check(CLI::Range(1, static_cast<int>(kMaxSlots)));
  app.add_flag("--die-with-parent", arguments.die_with_parent,
               "Die when the process that started this one ends");
  app.add_option("--parent", arguments.parent, "Process id of that process")->group("");
  app.add_flag("--watch-input", arguments.watch_input,
               "Drain when standard input ends: for a worker behind a pipe, such as ssh");
  app.add_option("--allow", arguments.allow,
                 "Program that campaigns may run here in place of the simulator, with any "
                 "arguments; repeatable")
      ->type_name("PROGRAM")
      ->allow_extra_args(false);
  app.add_flag("--allow-shell", arguments.allow_shell,
               "Run command lines that need a shell with /bin/sh: campaigns may then run anything");
  app.set_version_flag("--version", SWARMSMITH_VERSION);
  if (answer_scripts(app, std::vector<std::string>(argv + 1, argv + argc))) return 0;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream out;
    std::ostringstream errors;
    const int code = app.exit(error, out, errors);
    std::cout << out.str();
    std::cerr << as_shown(errors.str());  // contains the user's arguments
    return code == 0 ? 0 : static_cast<int>(WorkerExit::Usage);
  }
  if (!arguments.connect.empty()) {
    const auto endpoint = endpoint_of(arguments.connect, true);
    if (!endpoint) return fail(endpoint.error());
    arguments.connect = *endpoint;
  }
  return run(arguments);
}

}  // namespace
}  // namespace swarmsmith

int main(int argc, char** argv) {
  swarmsmith::begin_program();
  try {
    return swarmsmith::run_command_line(argc, argv);
  } catch (const std::exception& error) {
    swarmsmith::log_event(swarmsmith::LogLevel::Error, "worker", "failed",
                          {{"reason", error.what()}});
    return 1;
  }
}
