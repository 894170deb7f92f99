#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "base/process/interrupt.h"
#include "proto/scenario/scenario.h"
#include "worker/evaluator.h"

namespace swarmsmith {

/// The programs that a worker may run: a coordinator could name any.
struct AllowedPrograms {
  std::vector<std::string> programs;  ///< canonical absolute paths
  bool shell = false;                 ///< command lines that only a shell understands are run too
  /// Between two questions about a job of a batch system.
  std::chrono::milliseconds batch_poll = std::chrono::seconds(2);
};

/// The canonical path of a program that is to be allowed. Errors: there is none.
Expected<std::string> allowed_program(const std::string& path);

/// An evaluator that runs the scenario's programs (docs/targets.md). Scores are the negative of the
/// costs that they print. `interrupt` ends what runs. Errors: no target, a program that is not
/// allowed, or a folder that is not there, with what to do about it.
Expected<Evaluator> make_target_evaluator(std::shared_ptr<const WorkerScenario> scenario,
                                          const AllowedPrograms& allowed,
                                          std::shared_ptr<const Interrupt> interrupt);

}  // namespace swarmsmith
