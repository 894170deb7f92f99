#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "base/process/interrupt.h"
#include "proto/scenario/scenario.h"
#include "worker/evaluator.h"

namespace swarmsmith {

/// The programs that a worker may run, because a coordinator could name any program.
struct AllowedPrograms {
  std::vector<std::string> programs;  ///< canonical absolute paths
  bool shell = false;                 ///< whether to run command lines that need a shell
  /// Time between two queries about a job of a batch system.
  std::chrono::milliseconds batch_poll = std::chrono::seconds(2);
};

/// The canonical path of a program to allow. Errors: NotFound if it does not exist.
Expected<std::string> allowed_program(const std::string& path);

/// An evaluator that runs the scenario's programs (docs/targets.md). Scores are the negated costs
/// that they print. `interrupt` ends running programs. Errors: no target, a program that is not
/// allowed, or a missing folder; the messages say what to do.
Expected<Evaluator> make_target_evaluator(std::shared_ptr<const WorkerScenario> scenario,
                                          const AllowedPrograms& allowed,
                                          std::shared_ptr<const Interrupt> interrupt);

}  // namespace swarmsmith
