#pragma once

#include <optional>
#include <string>

#include "benchmarks/cluster/idle_worker.h"

namespace swarmsmith::bench {

/// Many workers in one thread: each has its own connection and the real protocol, but they share
/// one ZeroMQ context, and their slots are timers instead of threads. So a thousand of them cost
/// little beside the coordinator that is measured. Sleeping work only; returns when all were sent
/// home.
void run_crowd(const std::string& endpoint, const WorkerShape& shape,
               const std::optional<ClientKeys>& keys);

}  // namespace swarmsmith::bench
