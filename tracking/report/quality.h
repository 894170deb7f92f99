#pragma once

#include <string>

#include "tracking/scoring/run_findings.h"

namespace swarmsmith {

/// The quality report (tracking facts, section 11) as a JSON object, docs/tracking.md lists its
/// keys: what is stored with a score. Lengths in metres, angles in radians, as `_px` pixels.
std::string quality_json(const RunFindings& run);

/// The same as one page of HTML, the verdict first, with the run from above and a timeline.
std::string quality_html(const RunFindings& run);

}  // namespace swarmsmith
