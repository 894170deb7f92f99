#pragma once

#include <string>
#include <vector>

#include "coordinator/service/live_status.h"

namespace swarmsmith {

/// The status in Prometheus' text format, version 0.0.4. Labels are campaign, design and fixed
/// words only (orchestration facts, 11).
std::string metrics_text(const LiveStatus& status);

/// Names of all metrics, in the order of the text; histograms without _bucket, _sum, _count.
std::vector<std::string> metric_names();

}  // namespace swarmsmith
