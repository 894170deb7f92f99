#pragma once

namespace swarmsmith {

/// From now on, Ctrl-C and SIGTERM only request a stop and do not end the program.
void catch_stop_signals();
/// The signal that requested a stop; 0: none.
int stop_signal();

}  // namespace swarmsmith
