#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "base/expected.h"
#include "base/process/interrupt.h"
#include "base/process/process.h"
#include "programs/target.h"

namespace swarmsmith {

enum class JobState { Waits, Ended, Unknown };

/// How a batch system is asked for a job and told to end it.
struct BatchCommands {
  std::vector<std::string> ask;  ///< the job's id follows
  std::vector<std::string> end;  ///< likewise
};

/// Contract: not for BatchMode::None.
const BatchCommands& commands_of(BatchMode mode);

/// What the answer to `ask` means. Unknown: the batch system did not answer, which says nothing of
/// the job.
JobState state_of_job(BatchMode mode, const ProcessEnd& answer);

/// Asks every `poll` until the job has left the queue (irace facts, 18.5). An interrupt ends the
/// job. Errors: no such command, or a batch system that does not answer many times in a row.
Expected<void> wait_for_job(BatchMode mode, const std::string& job, std::chrono::milliseconds poll,
                            const Interrupt& interrupt);

}  // namespace swarmsmith
