#pragma once

namespace swarmsmith::cli {

// What a person or a batch system says to a run by signals; of the whole process.

/// SIGINT, SIGTERM and SIGXCPU are taken note of from now on; a second one of the first two ends
/// the process at once.
void catch_ending_signals();
/// The signal that asked for the end, or 0.
int ending_signal();

/// SIGHUP is taken note of from now on. Only where there is a list of clients to read again: else a
/// terminal that goes away ends the run, as it ends others.
void catch_hangup();
/// Whether there was one since the last call.
bool take_hangup();

}  // namespace swarmsmith::cli
