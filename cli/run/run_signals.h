#pragma once

namespace swarmsmith::cli {

// A person or a batch system controls a run with these signals. They concern the whole process.

/// From now on, SIGINT, SIGTERM and SIGXCPU are recorded; a second SIGINT or SIGTERM ends the
/// process at once.
void catch_ending_signals();
/// The recorded signal, or 0.
int ending_signal();

/// From now on, SIGHUP is recorded. Use this only if there is a list of clients to read again;
/// otherwise closing the terminal ends the run, as usual for programs.
void catch_hangup();
/// Whether SIGHUP came since the last call.
bool take_hangup();

}  // namespace swarmsmith::cli
