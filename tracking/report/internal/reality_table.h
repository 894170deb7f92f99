#pragma once

#include "analysis/report/html.h"
#include "tracking/scoring/run_findings.h"

namespace swarmsmith {

/// What logs and film tell of the robots' world; without rows where no robot has a log.
HtmlTable reality_table(const RunFindings& run);

}  // namespace swarmsmith
