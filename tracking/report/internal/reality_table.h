#pragma once

#include "analysis/report/html.h"
#include "tracking/scoring/run_findings.h"

namespace swarmsmith {

/// A table of the robots' behaviour according to their logs and the film; without rows if no robot
/// has a log.
HtmlTable reality_table(const RunFindings& run);

}  // namespace swarmsmith
