#pragma once

#include <string>

#include "tracking/scoring/run_findings.h"

namespace swarmsmith {

/// The quality report (tracking facts, section 11) as a JSON object, which is stored with a score;
/// docs/tracking.md lists its keys. Lengths are in metres, angles in radians, values with `_px` in
/// pixels.
std::string quality_json(const RunFindings& run);

/// The same as one HTML page: first the verdict, then the run from above and a timeline.
std::string quality_html(const RunFindings& run);

}  // namespace swarmsmith
