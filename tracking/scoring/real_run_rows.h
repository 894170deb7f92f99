#pragma once

#include <string>
#include <vector>

#include "storage/real_runs.h"
#include "tracking/observing/observations.h"
#include "tracking/rig/rig_file.h"
#include "tracking/scoring/run_findings.h"

namespace swarmsmith {

/// The run as rows; `starts_s` is of RunSpan. Left for the caller: the candidate, and of the score
/// the report and the program. The key is one of the videos' bytes and of where in them the run
/// begins.
RealRunRows real_run_rows(const RunFindings& run, const std::string& arena_text,
                          const std::vector<double>& starts_s);

/// What a run is scored from, without its videos.
struct StoredRun {
  Rig rig;  ///< with all robots and cameras of the arena file
  RunLog log;
  Observations observations;
};

/// The other way round, calibrations included; corners as stores keep them, which is all that
/// track_run looks at. Fails as parse_rig and parse_run_log do.
OrComplaints<StoredRun> stored_run(const RealRunRows& rows);

}  // namespace swarmsmith
