#include "base/process/begin_program.h"

#include <sys/auxv.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string_view>

namespace swarmsmith {
namespace {

/// All signals from outside; the others are faults of this process itself.
sigset_t signals_to_pass_on() {
  sigset_t signals;
  sigfillset(&signals);
  for (const int own :
       {SIGFPE, SIGILL, SIGSEGV, SIGBUS, SIGABRT, SIGTRAP, SIGSYS, SIGTTIN, SIGTTOU})
    sigdelset(&signals, own);
  return signals;
}

/// Ends this process with the child.
void reap(pid_t child) {
  int status = 0;
  while (true) {
    const pid_t ended = waitpid(-1, &status, WNOHANG);
    if (ended < 0 && errno == EINTR) continue;
    if (ended <= 0) return;
    if (ended != child) continue;
    _exit(WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status));
  }
}

[[noreturn]] void be_first(pid_t child, const sigset_t& signals) {
  prctl(PR_SET_NAME, "swarmsmith-init");
  while (true) {
    const int signal = sigwaitinfo(&signals, nullptr);
    if (signal > 0 && signal != SIGCHLD) kill(child, signal);
    reap(child);
  }
}

/// Moves this process into its own group, which gets the terminal, if there is one: otherwise
/// Ctrl-C would reach the program twice.
void take_foreground() {
  setpgid(0, 0);
  // tcsetpgrp stops a process of a background group with this signal (tcsetpgrp(3)).
  signal(SIGTTOU, SIG_IGN);
  tcsetpgrp(STDIN_FILENO, getpgrp());
  signal(SIGTTOU, SIG_DFL);
}

void leave_first_place() {
  if (getpid() != 1) return;
  const sigset_t signals = signals_to_pass_on();
  sigset_t before;
  sigprocmask(SIG_BLOCK, &signals, &before);
  const pid_t child = fork();
  if (child > 0) be_first(child, signals);
  if (child == 0) take_foreground();
  if (child < 0)
    std::fprintf(stderr, "process 1 cannot start its program: %s\n", std::strerror(errno));
  sigprocmask(SIG_SETMASK, &before, nullptr);
  // If no child can be started, this process goes on as the program: orphans stay zombies, but
  // everything else works.
}

void on_processor_limit(int) {
  constexpr std::string_view kSentence =
      "stopped: this process has used the processor time that it may use (ulimit -t)\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kSentence.data(), kSentence.size());
  _exit(128 + SIGXCPU);
}

/// Lowers the soft limit: at the hard limit the kernel kills without a signal that could be
/// handled, and `ulimit -t` sets both limits to the same value.
void part_processor_limits() {
  rlimit limit = {};
  if (getrlimit(RLIMIT_CPU, &limit) != 0 || limit.rlim_max == RLIM_INFINITY) return;
  const rlim_t margin = std::clamp<rlim_t>(limit.rlim_max / 10, 1, 30);
  if (limit.rlim_max <= margin || limit.rlim_cur <= limit.rlim_max - margin) return;
  limit.rlim_cur = limit.rlim_max - margin;
  setrlimit(RLIMIT_CPU, &limit);
}

/// Sets the process's name: in an archive (packaging/bundle) the kernel uses the loader's name.
void take_name() {
  // NOLINTNEXTLINE(performance-no-int-to-ptr): getauxval returns addresses as numbers
  const auto* const called = reinterpret_cast<const char*>(getauxval(AT_EXECFN));
  if (called == nullptr) return;
  const char* const slash = std::strrchr(called, '/');
  prctl(PR_SET_NAME, slash == nullptr ? called : slash + 1);
}

}  // namespace

void begin_program() {
  take_name();
  leave_first_place();
  signal(SIGXFSZ, SIG_IGN);
  signal(SIGXCPU, on_processor_limit);
  part_processor_limits();
}

}  // namespace swarmsmith
