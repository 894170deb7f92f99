#pragma once

namespace swarmsmith {

/// From now on Ctrl-C and SIGTERM request an end instead of ending the process, and a file that
/// becomes too large gives a write error.
void catch_stop_signals();
/// The signal that requested an end; 0: none.
int stop_signal();

/// Whether the other end of standard input is closed; does not wait, and discards input.
bool input_has_ended();

}  // namespace swarmsmith
