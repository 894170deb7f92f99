#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/expected.h"
#include "cli/replay/stored_runs.h"

namespace swarmsmith::cli {

/// How an evaluation that was made once more came out.
struct Again {
  enum class End {
    Scored,
    Failed,  ///< the simulation threw, or its score is not finite: there is no score
    Killed,  ///< its process died of it
  };
  End end = End::Scored;
  SimulationResult result;  ///< when it has a score
};

using EvaluateRun = std::function<SimulationResult(const StoredRun&)>;

/// Evaluates the runs in a child process, so that what kills the process is an outcome as any
/// other; the next ones get a new process. In the order of `runs`. Not for programs with several
/// threads. Errors: no process can be started.
Expected<std::vector<Again>> evaluate_apart(std::span<const StoredRun> runs,
                                            const EvaluateRun& evaluate);

}  // namespace swarmsmith::cli
