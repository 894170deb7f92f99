#pragma once

namespace swarmsmith {

/// The exit codes of all commands of the program. Scripts rely on them (docs/command-line.md).
enum class ExitCode : int {
  Done = 0,
  Failed = 1,       ///< the campaign, a module or a replay failed, or output could not be written
  Usage = 2,        ///< the command line or campaign file is wrong
  Store = 3,        ///< the store cannot be used
  NoSuchId = 4,     ///< no such design, candidate or evaluation
  Unreachable = 5,  ///< the coordinator or worker does not answer
  OverFailureLimit = 6,  ///< finished or stopped because evaluations failed too often
  InvalidRun = 6,        ///< `track score` and `robot start`: the run is not valid
  Interrupted = 130,     ///< by Ctrl-C; `run` can continue later
  Terminated = 143,      ///< by SIGTERM; `run` can continue later
};

}  // namespace swarmsmith
