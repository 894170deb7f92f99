#include "coordinator/cli/run_signals.h"

#include <unistd.h>
#include <csignal>

namespace swarmsmith::cli {
namespace {

// Set by the handlers, read by the loop.
volatile std::sig_atomic_t g_ending = 0;
volatile std::sig_atomic_t g_hangup = 0;

void on_ending(int signal) {
  if (g_ending != 0) _exit(128 + signal);
  g_ending = signal;
}

void on_hangup(int) {
  g_hangup = 1;
}

}  // namespace

void catch_ending_signals() {
  struct sigaction action = {};
  action.sa_handler = on_ending;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
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
  if (g_hangup == 0) return false;
  g_hangup = 0;
  return true;
}

}  // namespace swarmsmith::cli
