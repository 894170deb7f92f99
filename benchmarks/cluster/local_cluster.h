#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/expected.h"
#include "benchmarks/cluster/idle_worker.h"
#include "benchmarks/cluster/process_stats.h"
#include "coordinator/design/work_source.h"
#include "coordinator/service/live_status.h"

namespace swarmsmith::bench {

/// A real coordinator with a real store in a temporary folder, and worker processes on this host.
struct ClusterShape {
  int processes = 1;
  WorkerShape each;
  Work work;
  bool curve = false;  ///< whether connections are encrypted, with listed keys
  /// Number of designs in the store, with ids from 1; the source's candidates belong to them.
  int designs = 1;
};

struct ClusterRun {
  double wall_s = 0;     ///< from the first connection to the last row on disk
  double connect_s = 0;  ///< from the start until all workers were connected
  CpuByThread coordinator;
  double workers_cpu_s = 0;
  double resident_mb = 0;  ///< of the coordinator, at the end
  double store_mb = 0;
};

/// Runs the source to its end. `on_status`, which is called ten times a second, may be empty;
/// `on_rows` gets each unit of rows.
Expected<ClusterRun> run_cluster(const ClusterShape& shape, WorkSource& source,
                                 const std::function<void(const LiveStatus&)>& on_status = {},
                                 const std::function<void(std::span<const Row>)>& on_rows = {});

}  // namespace swarmsmith::bench
