#pragma once

namespace swarmsmith {

/// What every command of the program exits with; a promise to scripts (docs/command-line.md).
enum class ExitCode : int {
  Done = 0,
  Failed = 1,       ///< the campaign, a module or a replay failed, or output could not be written
  Usage = 2,        ///< command line or campaign file wrong
  Store = 3,        ///< the store cannot be used
  NoSuchId = 4,     ///< no such design, candidate or evaluation
  Unreachable = 5,  ///< coordinator or worker does not answer
  OverFailureLimit = 6,  ///< finished or stopped because evaluations could not be had
  InvalidRun = 6,        ///< of `track score` and `robot start`: the run is not fit to be counted
  Interrupted = 130,     ///< by Ctrl-C; `run` goes on
  Terminated = 143,      ///< by SIGTERM; `run` goes on
};

}  // namespace swarmsmith
