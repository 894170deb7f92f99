#pragma once

#include <optional>
#include <string>

#include "benchmarks/cluster/idle_worker.h"

namespace swarmsmith::bench {

/// Many workers in one thread. Each has its own connection and uses the real protocol, but all
/// share one ZeroMQ context, and their slots are timers instead of threads. So a thousand of them
/// cost little compared with the measured coordinator. Only for work that sleeps. Returns after the
/// coordinator has dismissed all of them.
void run_crowd(const std::string& endpoint, const WorkerShape& shape,
               const std::optional<ClientKeys>& keys);

}  // namespace swarmsmith::bench
