#pragma once

#include <string>

#include "base/text/json.h"
#include "tracking/robots/reality.h"

namespace swarmsmith {

/// The line that is printed with a run's score: "of what is commanded it drives 97.1 % +- 0.4 %
/// ...".
std::string reality_text(const Reality& reality);

/// An object with the keys `way`, `turn`, `neighbours`, `delays_s`, `period_s` and `states`
/// (docs/tracking.md, "Reality's figures").
JsonObject reality_json(const Reality& reality);

/// A robot's entry under `neighbours` in a quality report, needed because stores do not keep the
/// readings. Without an entry the result has a reason.
NeighboursSeen neighbours_in_report(const std::string& report, const std::string& robot);

}  // namespace swarmsmith
