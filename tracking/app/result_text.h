#pragma once

#include <string>

#include "storage/real_runs.h"
#include "tracking/app/run_analysis.h"

namespace swarmsmith::cli {

/// What a person wants to know of a scored run: score, verdict and why, and how well each robot was
/// seen.
std::string result_text(const RunLog& log, const RunAnalysis& analysis);

/// The same as the keys of a JSON object, without its braces.
std::string result_json(const RunLog& log, const RunAnalysis& analysis);

/// Of a run that is stored, from its rows.
std::string result_text(const RealRunRows& rows);
std::string result_json(const RealRunRows& rows);

/// "12", "-3.25", "no score".
std::string score_text(const std::optional<double>& score);

/// The measured trajectory as the simulator writes its own.
std::string trajectory_csv(const TrackedRun& tracked);

}  // namespace swarmsmith::cli
