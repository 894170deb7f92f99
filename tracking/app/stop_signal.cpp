#include "tracking/app/stop_signal.h"

#include <atomic>
#include <csignal>

namespace swarmsmith {
namespace {

/// A signal handler may run in any thread.
std::atomic<bool> asked = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void ask(int /*signal*/) {
  asked = true;
}

}  // namespace

void catch_stop_signals() {
  struct sigaction action {};
  action.sa_handler = ask;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool stop_was_asked_for() {
  return asked;
}

}  // namespace swarmsmith
