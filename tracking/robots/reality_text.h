#pragma once

#include <string>

#include "base/text/json.h"
#include "tracking/robots/reality.h"

namespace swarmsmith {

/// What is printed with a run's score, one line: "drives 97.1 % +- 0.4 % of the way told, ...".
std::string reality_text(const Reality& reality);

/// An object with the keys `way`, `turn`, `neighbours`, `delays_s`, `period_s` and `states`
/// (docs/tracking.md, "Reality's figures").
JsonObject reality_json(const Reality& reality);

/// What a quality report has under `neighbours` for a robot: stores do not keep the readings. Of
/// one without them a result with a reason.
NeighboursSeen neighbours_in_report(const std::string& report, const std::string& robot);

}  // namespace swarmsmith
