#pragma once

#include <string>

#include "base/text/json.h"
#include "tracking/app/run_analysis.h"

namespace swarmsmith::cli {

/// What a person wants to know of a scored run: score, verdict and why, how well each robot was
/// seen, and what was checked: all of it with `all_checks`, else what did not pass.
std::string result_text(const RunLog& log, const RunAnalysis& analysis, bool all_checks = false);

/// The same as keys of the object.
void add_result(JsonObject& object, const RunLog& log, const RunAnalysis& analysis);

/// "12", "-3.25", "no score".
std::string score_text(const std::optional<double>& score);

/// The measured trajectory as the simulator writes its own.
std::string trajectory_csv(const TrackedRun& tracked);

}  // namespace swarmsmith::cli
