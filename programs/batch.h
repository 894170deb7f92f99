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

/// The commands that ask a batch system about a job, and end the job.
struct BatchCommands {
  std::vector<std::string> ask;  ///< the job's id is added
  std::vector<std::string> end;  ///< the job's id is added
};

/// Must not be called with BatchMode::None.
const BatchCommands& commands_of(BatchMode mode);

/// Interprets the answer to `ask`. Unknown: the batch system did not answer, so the state of the
/// job is not known.
JobState state_of_job(BatchMode mode, const ProcessEnd& answer);

/// Asks every `poll` until the job has left the queue (irace facts, 18.5). An interrupt ends the
/// job. Errors: the command does not exist, or the batch system does not answer many times in a
/// row.
Expected<void> wait_for_job(BatchMode mode, const std::string& job, std::chrono::milliseconds poll,
                            const Interrupt& interrupt);

}  // namespace swarmsmith
