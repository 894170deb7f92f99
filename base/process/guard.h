#pragma once

#include <sys/types.h>

#include "base/expected.h"

namespace swarmsmith {

/// A small process beside this one that outlives it, however it ends (kill -9 too), and then ends
/// the groups of programs that ran: the kernel tells a program of its parent's death, but not what
/// the program started. Call it early, before there are threads. Without a guard `guard` and
/// `unguard` do nothing.
Expected<void> start_guard();

/// A process group that is to end with this process. Any thread, and a child of vfork: it only
/// writes to a pipe.
void guard(pid_t group);
/// It has ended.
void unguard(pid_t group);
/// Whether there is a guard.
bool is_guarded();

}  // namespace swarmsmith
