#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/expected.h"
#include "coordinator/launchers/launch_options.h"
#include "programs/target.h"

namespace swarmsmith {

/// Arguments that allow a worker to run a user's own programs, and a shell for their command lines.
std::vector<std::string> allow_arguments(const Target& target);

/// Arguments with which a worker finds the coordinator and authenticates. Secrets are passed as
/// files, never on a command line.
std::vector<std::string> address_arguments(const WorkerAddress& address);

/// The path of `swarmsmith-worker`: from SWARMSMITH_WORKER, else beside this program.
Expected<std::filesystem::path> find_worker_program();

/// Quotes the words so that a POSIX shell splits the line into the same words.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace swarmsmith
