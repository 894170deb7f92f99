#include "base/process/stop_signal.h"

#include <atomic>
#include <csignal>

namespace swarmsmith {
namespace {

/// Atomic, because a signal handler may run in any thread.
std::atomic<int> requested_by = 0;
static_assert(std::atomic<int>::is_always_lock_free);

void request(int signal) {
  requested_by = signal;
}

}  // namespace

void catch_stop_signals() {
  struct sigaction action {};
  action.sa_handler = request;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

int stop_signal() {
  return requested_by;
}

}  // namespace swarmsmith
