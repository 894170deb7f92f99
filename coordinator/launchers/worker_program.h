#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/expected.h"
#include "coordinator/launchers/launch_options.h"
#include "programs/target.h"

namespace swarmsmith {

/// Arguments that let a worker run a user's own programs, and a shell for their command lines.
std::vector<std::string> allow_arguments(const Target& target);

/// Arguments that let a worker find the coordinator and show who it is. Secrets are files: none of
/// them is on a command line.
std::vector<std::string> address_arguments(const WorkerAddress& address);

/// The program `swarmsmith-worker`: SWARMSMITH_WORKER names it, else it lies beside this program.
Expected<std::filesystem::path> find_worker_program();

/// The words as one line that a POSIX shell takes apart into the same words.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace swarmsmith
