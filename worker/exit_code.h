#pragma once

namespace swarmsmith {

/// How a worker process ends, for batch systems and launchers.
enum class ExitCode : int {
  Done = 0,  ///< drained: everything was reported or given back
  Usage = 2,
  Unreachable = 5,    ///< no coordinator for ten minutes
  Refused = 7,        ///< the coordinator does not want this build: starting it again is useless
  Interrupted = 143,  ///< a second SIGTERM
};

}  // namespace swarmsmith
