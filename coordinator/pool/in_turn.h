#pragma once

#include <set>

#include "coordinator/pool/worker_loads.h"

namespace swarmsmith {

/// Calls `what` for each worker of a set, beginning after `last` and going round once, until it
/// says false. The set may change meanwhile.
template <class What>
void in_turn(const std::set<WorkerNumber>& workers, WorkerNumber last, const What& what) {
  for (auto at = workers.upper_bound(last); at != workers.end();) {
    const WorkerNumber worker = *at;
    if (!what(worker)) return;
    at = workers.upper_bound(worker);
  }
  for (auto at = workers.begin(); at != workers.end() && *at <= last;) {
    const WorkerNumber worker = *at;
    if (!what(worker)) return;
    at = workers.upper_bound(worker);
  }
}

}  // namespace swarmsmith
