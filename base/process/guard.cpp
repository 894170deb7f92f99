#include "base/process/guard.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <vector>

namespace swarmsmith {
namespace {

constexpr int kTermGraceMs = 500;

std::atomic<int> g_to_guard{-1};

/// Writes a whole word: a pipe does not split writes shorter than PIPE_BUF.
void tell(pid_t word) {
  const int descriptor = g_to_guard.load(std::memory_order_relaxed);
  if (descriptor < 0) return;
  while (write(descriptor, &word, sizeof word) < 0 && errno == EINTR) {
  }
}

/// Runs until the last writer, the guarded process, is gone.
[[noreturn]] void watch(int descriptor) {
  // Ctrl-C and the batch system's signals go to whole groups, but this process must outlive them.
  setpgid(0, 0);
  for (const int ignored : {SIGINT, SIGTERM, SIGHUP, SIGPIPE})
    std::signal(ignored, SIG_IGN);
  prctl(PR_SET_NAME, "swarmsmith-grd");
  // A program that waits for the end of the guarded process's output must not wait for this
  // process.
  const auto own = static_cast<unsigned>(descriptor);
  if (own > 0) close_range(0, own - 1, 0);
  close_range(own + 1, ~0U, 0);
  std::vector<pid_t> groups;
  pid_t word = 0;
  while (true) {
    const ssize_t got = read(descriptor, &word, sizeof word);
    if (got < 0 && errno == EINTR) continue;
    if (got != sizeof word) break;
    if (word > 0) {
      groups.push_back(word);
    } else {
      std::erase(groups, -word);
    }
  }
  for (const pid_t group : groups)
    kill(-group, SIGTERM);
  if (!groups.empty()) poll(nullptr, 0, kTermGraceMs);
  for (const pid_t group : groups)
    kill(-group, SIGKILL);
  _exit(0);
}

}  // namespace

Expected<void> start_guard() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    return unexpected(ErrorKind::Unavailable, std::string("no pipe: ") + std::strerror(errno));
  }
  const pid_t child = fork();
  if (child < 0) {
    return unexpected(ErrorKind::Unavailable, std::string("no process: ") + std::strerror(errno));
  }
  if (child == 0) {
    close(ends[1]);
    watch(ends[0]);
  }
  close(ends[0]);
  g_to_guard = ends[1];
  return {};
}

void guard(pid_t group) {
  tell(group);
}

void unguard(pid_t group) {
  tell(-group);
}

bool is_guarded() {
  return g_to_guard.load(std::memory_order_relaxed) >= 0;
}

}  // namespace swarmsmith
