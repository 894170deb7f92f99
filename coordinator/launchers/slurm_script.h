#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coordinator/launchers/launch_options.h"

namespace swarmsmith {

/// The contents of the batch script that starts one worker per job.
struct SlurmScript {
  std::string job_name;
  std::filesystem::path folder;      ///< for the jobs' outputs; absolute
  std::vector<std::string> command;  ///< the worker's program and its arguments
  SlurmOptions options;
};

/// The text of the script. It has everything that sbatch needs, so that a person can submit it by
/// hand: --requeue; a signal one minute before the time limit, sent to the shell (B:), which the
/// worker has replaced by then (exec); and the user's own options, which come last and have
/// priority.
std::string text_of(const SlurmScript& script);

}  // namespace swarmsmith
