#pragma once

#include <sys/types.h>

#include "base/expected.h"

namespace swarmsmith {

/// Starts a small process that outlives this one, however it ends (also by kill -9), and then ends
/// the process groups of the programs that were running. The kernel can end a program when its
/// parent dies, but not the processes that the program has started. To be called early, before
/// there are threads. Without a guard, `guard` and `unguard` do nothing.
Expected<void> start_guard();

/// Registers a process group that must end with this process. Can be called from any thread, and in
/// a child of vfork: it only writes to a pipe.
void guard(pid_t group);
/// Reports that the group has ended.
void unguard(pid_t group);
/// Whether there is a guard.
bool is_guarded();

}  // namespace swarmsmith
