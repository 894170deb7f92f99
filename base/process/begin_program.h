#pragma once

namespace swarmsmith {

/// To be called first in `main`, before there are threads.
///
/// If it is process 1 of a container, this process starts the real program as a child, passes
/// signals on to it, reaps orphans, and ends as the child does; the call returns in the child. The
/// kernel gives orphans to process 1, and withholds signals that process 1 does not handle: if the
/// programs of a worker left processes behind, it would collect zombies until no process could be
/// made.
///
/// Limits of the system that would end the program silently give a message. A file that may not
/// grow (ulimit -f) causes an error when writing, as on a full disk; at the end of its processor
/// time (ulimit -t) the program reports that. SIGXCPU arrives some time before the kernel kills the
/// program, and may be handled.
void begin_program();

}  // namespace swarmsmith
