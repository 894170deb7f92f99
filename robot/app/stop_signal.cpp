#include "robot/app/stop_signal.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>

namespace swarmsmith {
namespace {

/// Atomic, because a signal handler may run in any thread.
std::atomic<int> asked_by = 0;
static_assert(std::atomic<int>::is_always_lock_free);

void ask(int signal) {
  asked_by = signal;
}

}  // namespace

void catch_stop_signals() {
  struct sigaction action {};
  action.sa_handler = ask;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

int stop_signal() {
  return asked_by;
}

bool input_has_ended() {
  while (true) {
    pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
    if (::poll(&input, 1, 0) <= 0) return false;
    if ((input.revents & POLLIN) == 0) return true;  // closed, or no descriptor at all
    std::array<char, 256> ignored{};
    const ssize_t read = ::read(STDIN_FILENO, ignored.data(), ignored.size());
    if (read == 0 || (read < 0 && errno != EINTR && errno != EAGAIN)) return true;
    if (read < 0) return false;
  }
}

}  // namespace swarmsmith
