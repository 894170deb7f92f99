#pragma once

#include <string>
#include <vector>

#include "coordinator/service/live_status.h"

namespace swarmsmith {

/// The status in Prometheus' text format, version 0.0.4. Labels are only campaign, design and words
/// of fixed lists (orchestration facts, 11).
std::string metrics_text(const LiveStatus& status);

/// Names of all metrics, in the order of the text; of histograms without _bucket, _sum, _count.
std::vector<std::string> metric_names();

}  // namespace swarmsmith
