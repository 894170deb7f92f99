#pragma once

namespace swarmsmith {

/// From now on Ctrl-C and SIGTERM ask for an end instead of being one.
void catch_stop_signals();
/// Whether one of them came.
bool stop_was_asked_for();

}  // namespace swarmsmith
