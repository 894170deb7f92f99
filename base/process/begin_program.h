#pragma once

namespace swarmsmith {

/// Call first in `main`, before there are threads.
///
/// As process 1 of a container, this process starts the real program as a child, passes signals on
/// to it, reaps what loses its parent, and ends as the child does; the call returns in the child.
/// The kernel gives orphans to process 1, and keeps signals from it that it does not handle: a
/// worker whose programs leave processes behind would collect zombies until no process can be made.
///
/// What a limit of the system would end without a word has one: a file that may not grow (ulimit
/// -f) is an error of writing it, as on a full disk; at the end of its processor time (ulimit -t)
/// the program says so. SIGXCPU comes a while before the kernel kills it, and may be handled.
void begin_program();

}  // namespace swarmsmith
