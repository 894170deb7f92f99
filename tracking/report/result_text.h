#pragma once

#include <optional>
#include <string>

#include "base/text/json.h"
#include "tracking/scoring/run_findings.h"

namespace swarmsmith {

/// What a person wants to know of a scored run: score, verdict and why, how well each robot was
/// seen, and what was checked: all of it with `all_checks`, else what did not pass.
std::string result_text(const RunFindings& run, bool all_checks = false);

/// The same as keys of the object.
void add_result(JsonObject& object, const RunFindings& run);

/// "12", "-3.25", "no score".
std::string score_text(const std::optional<double>& score);

/// The measured trajectory as the simulator writes its own.
std::string trajectory_csv(const TrackedRun& tracked);

}  // namespace swarmsmith
