#pragma once

#include <string>

#include "storage/real_runs.h"
#include "tracking/app/run_analysis.h"
#include "tracking/report/quality.h"

namespace swarmsmith::cli {

/// The parts of a run that a report speaks of; they must live as long as the value.
ReportedRun reported_run(const Rig& rig, const RunLog& log, const Observations& observations,
                         const RunAnalysis& analysis);

/// The run as rows, with candidate, report and program.
RealRunRows rows_of(const ReportedRun& reported, const RunAnalysis& analysis,
                    const std::string& arena_text, CandidateId candidate);

}  // namespace swarmsmith::cli
