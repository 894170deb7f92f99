#pragma once

#include <optional>
#include <string>

#include "base/text/json.h"
#include "tracking/scoring/run_findings.h"

namespace swarmsmith {

/// The result of a scored run as text: score, verdict with its reasons, how well each robot was
/// seen, and its checks: all of them with `all_checks`, otherwise only those that did not pass.
std::string result_text(const RunFindings& run, bool all_checks = false);

/// The same as keys of a JSON object.
void add_result(JsonObject& object, const RunFindings& run);

/// A score as text: "12", "-3.25", "no score".
std::string score_text(const std::optional<double>& score);

/// The measured trajectory in the simulator's CSV format.
std::string trajectory_csv(const TrackedRun& tracked);

}  // namespace swarmsmith
