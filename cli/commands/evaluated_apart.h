#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/expected.h"
#include "cli/replay/stored_runs.h"

namespace swarmsmith::cli {

/// The result of repeating an evaluation.
struct Again {
  enum class End {
    Scored,
    Failed,  ///< the simulation threw, or the score is not finite: there is no score
    Killed,  ///< the evaluation killed its process
  };
  End end = End::Scored;
  Measured result;  ///< if there is a score
};

using EvaluateRun = std::function<Measured(const StoredRun&)>;

/// Evaluates the runs in a child process, so that a crash is an outcome like any other; the runs
/// after it get a new process. The results are in the order of `runs`. Not for programs with
/// several threads. Errors: no process can be started.
Expected<std::vector<Again>> evaluate_apart(std::span<const StoredRun> runs,
                                            const EvaluateRun& evaluate);

}  // namespace swarmsmith::cli
