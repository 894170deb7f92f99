#pragma once

#include <string>

#include "worker/protocol.h"

namespace swarmsmith {

/// How many evaluations this process may run at a time: SLURM_CPUS_PER_TASK, else the
/// processors that it may use (base/usable_processors.h).
int available_slots();

/// Who this process is: host (Slurm's name for its node first), pid, job of the batch system, and
/// a random id.
WorkerIdentity identity_of_this_process(int slots, std::string build);

}  // namespace swarmsmith
