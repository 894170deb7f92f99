#include "cli/run/run_signals.h"

#include <unistd.h>
#include <atomic>
#include <csignal>

namespace swarmsmith::cli {
namespace {

// Set by the handlers, which may run in any thread; read by the main loop.
std::atomic<int> g_ending = 0;
std::atomic<bool> g_hangup = false;
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

void on_ending(int signal) {
  if (g_ending.exchange(signal) != 0) _exit(128 + signal);
}

/// The signal is repeated after each further second of processor time.
void on_processor_limit(int signal) {
  int none = 0;
  g_ending.compare_exchange_strong(none, signal);
}

void on_hangup(int) {
  g_hangup = true;
}

}  // namespace

void catch_ending_signals() {
  struct sigaction action = {};
  action.sa_handler = on_ending;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  action.sa_handler = on_processor_limit;
  sigaction(SIGXCPU, &action, nullptr);
}

int ending_signal() {
  return g_ending;
}

void catch_hangup() {
  struct sigaction action = {};
  action.sa_handler = on_hangup;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGHUP, &action, nullptr);
}

bool take_hangup() {
  return g_hangup.exchange(false);
}

}  // namespace swarmsmith::cli
