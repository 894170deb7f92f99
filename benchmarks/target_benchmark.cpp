// What does a call of a target-runner cost in addition to the program itself? Calls /bin/echo in a
// bare loop of posix_spawn, with run_process, and with the whole runner (arguments, output,
// numbers).
//
//   target_benchmark [CALLS]

#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <thread>
#include <vector>

#include "programs/runner.h"

namespace swarmsmith {
namespace {

void bare_call() {
  char program[] = "/bin/echo";
  char word[] = "1";
  char* words[] = {program, word, nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", 1, 0);
  pid_t pid = 0;
  if (posix_spawn(&pid, program, &actions, nullptr, words, environ) != 0) std::abort();
  posix_spawn_file_actions_destroy(&actions);
  waitpid(pid, nullptr, 0);
}

/// CPU time of this process and of the programs that it ran.
double cpu_us() {
  double sum = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    for (const timeval& part : {usage.ru_utime, usage.ru_stime})
      sum += 1e6 * static_cast<double>(part.tv_sec) + static_cast<double>(part.tv_usec);
  }
  return sum;
}

/// Microseconds per call: wall time with this many threads calling at the same time, and CPU time.
struct Cost {
  double wall = 0;
  double cpu = 0;
};

Cost cost_of(int calls, int threads, const std::function<void()>& call) {
  const auto begin = std::chrono::steady_clock::now();
  const double cpu = cpu_us();
  {
    std::vector<std::jthread> all;
    for (int thread = 0; thread < threads; ++thread) {
      all.emplace_back([&] {
        for (int i = 0; i < calls / threads; ++i)
          call();
      });
    }
  }
  const std::chrono::duration<double, std::micro> spent = std::chrono::steady_clock::now() - begin;
  return {spent.count() / calls, (cpu_us() - cpu) / calls};
}

void compare(int calls, int threads) {
  const Interrupt never;
  Target target;
  target.runner = "/bin/echo";
  target.folder = "/";
  target.command_line = "-n {targetRunnerArgs}";
  const TargetRunner runner(target, {}, never);
  const Cost bare = cost_of(calls, threads, bare_call);
  const Cost process = cost_of(calls, threads, [&] {
    if (!run_process({.words = {"/bin/echo", "1"}}, never)) std::abort();
  });
  const Cost whole = cost_of(calls, threads, [&] {
    if (!runner.run({.configuration = 1, .instance_id = "1", .seed = 1, .switches = "1.5"})) {
      std::abort();
    }
  });
  const auto show = [&](const char* name, const Cost& cost) {
    std::printf("  %-12s wall %6.0f us (%.2f), CPU %6.0f us (%.2f)\n", name, cost.wall,
                cost.wall / bare.wall, cost.cpu, cost.cpu / bare.cpu);
  };
  std::printf("%d at a time\n", threads);
  show("posix_spawn", bare);
  show("run_process", process);
  show("runner", whole);
}

}  // namespace
}  // namespace swarmsmith

int main(int argc, char** argv) {
  const int calls = argc > 1 ? std::atoi(argv[1]) : 4000;
  for (int round = 0; round < 3; ++round) {
    swarmsmith::compare(calls, 1);
    swarmsmith::compare(calls, 4);
  }
}
