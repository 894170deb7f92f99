#pragma once

#include <string>
#include <vector>

#include "storage/real_runs.h"
#include "tracking/observing/observations.h"
#include "tracking/rig/rig_file.h"
#include "tracking/scoring/run_findings.h"

namespace swarmsmith {

/// The rows of a run for a store; `starts_s` is RunSpan::starts_s. The caller adds the candidate,
/// and the score's report and program. The key depends on the videos' contents and on the time in
/// them at which the run begins.
RealRunRows real_run_rows(const RunFindings& run, const std::string& arena_text,
                          const std::vector<double>& starts_s);

/// The data from which a run is scored, without its videos.
struct StoredRun {
  Rig rig;  ///< with all robots and cameras of the arena file
  RunLog log;
  Observations observations;
};

/// The inverse of real_run_rows, including calibrations; corners are rounded as in stores, which is
/// all that track_run uses. Fails like parse_rig and parse_run_log.
OrComplaints<StoredRun> stored_run(const RealRunRows& rows);

}  // namespace swarmsmith
