#pragma once

#include <string>

#include "worker/protocol.h"

namespace swarmsmith {

/// The number of evaluations that this process may run at a time: SLURM_CPUS_PER_TASK, else the
/// number of processors that it may use (base/usable_processors.h).
int available_slots();

/// The identity of this process: host (in Slurm, the node's name), pid, job of the batch system,
/// and a random id.
WorkerIdentity identity_of_this_process(int slots, std::string build);

}  // namespace swarmsmith
