#pragma once

namespace swarmsmith {

/// From now on, Ctrl-C and SIGTERM only request a stop and do not end the program.
void catch_stop_signals();
/// Whether a stop was requested.
bool stop_was_asked_for();

}  // namespace swarmsmith
