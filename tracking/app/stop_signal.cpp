#include "tracking/app/stop_signal.h"

#include <csignal>

namespace swarmsmith::cli {
namespace {

volatile std::sig_atomic_t asked = 0;

void ask(int /*signal*/) {
  asked = 1;
}

}  // namespace

void catch_stop_signals() {
  struct sigaction action {};
  action.sa_handler = ask;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool stop_was_asked_for() {
  return asked != 0;
}

}  // namespace swarmsmith::cli
