#pragma once

namespace swarmsmith {

/// From now on Ctrl-C and SIGTERM ask for an end instead of being one, and a file that grows too
/// large is an error of writing it.
void catch_stop_signals();
/// The signal that asked for an end; 0: none did.
int stop_signal();

/// Whether the other end of standard input is closed; does not wait, and reads
/// what comes.
bool input_has_ended();

}  // namespace swarmsmith
