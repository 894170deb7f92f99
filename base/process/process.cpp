#include "base/process/process.h"

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <optional>

#include "base/environment.h"
#include "base/process/guard.h"
#include "base/process/internal/spawn.h"
#include "base/program_path.h"

namespace swarmsmith {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// How often to check for the end of a process when the kernel does not report it.
constexpr milliseconds kLookAgain{10};
constexpr int kChunksAtOnce = 16;  // more than a pipe holds

/// A running program: its pipes, its end, its deadlines.
class Running {
 public:
  Running(const ProcessCall& call, Child child, const Interrupt& interrupt)
      : call_(call), child_(std::move(child)), interrupt_(interrupt) {
    if (call_.limit.count() > 0) next_signal_ = Clock::now() + call_.limit;
  }

  /// Nothing of the group may remain, whatever happens.
  ~Running() {
    kill(-child_.pid, SIGKILL);
    kill(child_.pid, SIGKILL);
    unguard(child_.pid);
    int status = 0;
    while (waitpid(child_.pid, &status, 0) < 0 && errno == EINTR) {
    }
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  ProcessEnd finish() {
    while (!done()) {
      wait();
      take(child_.output, end_.output);
      take(child_.errors, end_.errors);
      look_for_end();
      keep_time();
    }
    return std::move(end_);
  }

 private:
  bool closed() const { return child_.output.get() < 0 && child_.errors.get() < 0; }
  bool done() const { return ended_ && (closed() || Clock::now() >= *pipes_until_); }

  void wait() const {
    const bool may_interrupt = !ended_ && end_.why == ProcessEnd::Why::Itself;
    std::array<pollfd, 4> watched{{{child_.output.get(), POLLIN, 0},
                                   {child_.errors.get(), POLLIN, 0},
                                   {ended_ ? -1 : child_.ended.get(), POLLIN, 0},
                                   {may_interrupt ? interrupt_.descriptor() : -1, POLLIN, 0}}};
    poll(watched.data(), watched.size(), time_left());
  }

  int time_left() const {
    std::optional<Clock::time_point> until = ended_ ? pipes_until_ : next_signal_;
    if (!ended_ && child_.ended.get() < 0) {
      const auto look = Clock::now() + kLookAgain;
      until = until ? std::min(*until, look) : look;
    }
    if (!until) return -1;
    const auto left = std::chrono::ceil<milliseconds>(*until - Clock::now()).count();
    constexpr std::int64_t kLongest = 1'000'000;
    return static_cast<int>(std::clamp<std::int64_t>(left, 0, kLongest));
  }

  void take(Descriptor& from, Captured& to) const {
    if (from.get() < 0) return;
    std::array<char, 16384> chunk;
    // There is a limit, since a program that prints without end must still meet its deadline.
    for (int i = 0; i < kChunksAtOnce; ++i) {
      const ssize_t got = read(from.get(), chunk.data(), chunk.size());
      if (got < 0 && errno == EINTR) continue;
      if (got < 0 && errno == EAGAIN) return;
      if (got <= 0) return from.reset();
      to.size += static_cast<std::uint64_t>(got);
      to.text.append(chunk.data(), static_cast<std::size_t>(got));
      // Cut in large steps, so that a lot of output costs little.
      if (to.text.size() > 2 * call_.keep) to.text.erase(0, to.text.size() - call_.keep);
      if (static_cast<std::size_t>(got) < chunk.size()) return;
    }
  }

  /// Does not reap: as long as the process is a zombie, its group's number cannot be used again.
  void look_for_end() {
    if (ended_) return;
    siginfo_t info{};
    const auto id = static_cast<id_t>(child_.pid);
    if (waitid(P_PID, id, &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid == 0) return;
    ended_ = true;
    pipes_until_ = Clock::now() + call_.pipe_grace;
    if (info.si_code == CLD_EXITED) {
      end_.exit_code = info.si_status;
    } else {
      end_.signal = info.si_status;
    }
    // Its last output, from before its end.
    take(child_.output, end_.output);
    take(child_.errors, end_.errors);
    // A program that was ended gets no more time for the processes that it left behind.
    if (end_.why != ProcessEnd::Why::Itself) pipes_until_ = Clock::now();
  }

  void keep_time() {
    if (ended_) return;
    if (end_.why == ProcessEnd::Why::Itself) {
      const bool late = next_signal_ && Clock::now() >= *next_signal_;
      if (!late && !interrupt_.triggered()) return;
      end_.why = late ? ProcessEnd::Why::Limit : ProcessEnd::Why::Interrupted;
      kill(-child_.pid, SIGTERM);
      next_signal_ = Clock::now() + call_.term_grace;
    } else if (next_signal_ && Clock::now() >= *next_signal_) {
      kill(-child_.pid, SIGKILL);
      kill(child_.pid, SIGKILL);  // it may have joined another group
      next_signal_.reset();
    }
  }

  const ProcessCall& call_;
  Child child_;
  const Interrupt& interrupt_;
  ProcessEnd end_;
  bool ended_ = false;
  std::optional<Clock::time_point> next_signal_;
  std::optional<Clock::time_point> pipes_until_;
};

void keep_end(Captured& captured, std::size_t keep) {
  if (captured.text.size() > keep) captured.text.erase(0, captured.text.size() - keep);
}

}  // namespace

Expected<std::string> find_program(const std::string& name) {
  if (name.find('/') != std::string::npos) return name;
  const auto file = program_in(environment("PATH", "/usr/local/bin:/usr/bin:/bin"), name);
  if (file) return file->string();
  return unexpected(ErrorKind::NotFound, "there is no program " + name + " in PATH");
}

Expected<ProcessEnd> run_process(const ProcessCall& call, const Interrupt& interrupt) {
  const Expected<std::string> program =
      call.file.empty() ? find_program(call.words.at(0)) : call.file;
  if (!program) return Unexpected(program.error());
  Expected<Child> child = spawn(*program, call.words, call.folder);
  if (!child) return Unexpected(child.error());
  ProcessEnd end = Running(call, std::move(*child), interrupt).finish();
  keep_end(end.output, call.keep);
  keep_end(end.errors, call.keep);
  return end;
}

}  // namespace swarmsmith
