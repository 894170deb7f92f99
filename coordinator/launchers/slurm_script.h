#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coordinator/launchers/launch_options.h"

namespace swarmsmith {

/// The batch script that starts one worker a job.
struct SlurmScript {
  std::string job_name;
  std::filesystem::path folder;      ///< for the jobs' outputs; absolute
  std::vector<std::string> command;  ///< the worker's program and its arguments
  SlurmOptions options;
};

/// Its text. All that sbatch needs is in it, so that a person can submit it by hand:
/// --requeue, a signal a minute before the time limit (to the shell, which by then *is* the worker:
/// B: and exec), and the user's own options, which come last and win.
std::string text_of(const SlurmScript& script);

}  // namespace swarmsmith
