#pragma once

#include <string>
#include <vector>

#include "storage/real_runs.h"
#include "tracking/app/refusal.h"
#include "tracking/observing/observations.h"
#include "tracking/rig/rig.h"
#include "tracking/rig/run_log.h"
#include "tracking/scoring/run_findings.h"

namespace swarmsmith {

/// A run: its sightings, its log, and all results computed from them.
struct AnalysedRun {
  Rig rig;  ///< only the cameras and robots of the run
  RunLog log;
  Observations observations;
  std::vector<double> starts_s;  ///< start of the run on each camera's clock
  TrackedRun tracked;
  ScoredRun scored;

  /// The findings, with this program's name. The run must outlive them and must not be moved.
  RunFindings findings() const;
  /// The run as rows, with candidate, report and program.
  RealRunRows rows(const std::string& arena_text, CandidateId candidate) const;
};

/// The start of a run on each camera's clock, from the log or from the sync tag.
Expected<std::vector<double>> starts_of(const Observations& observations, const RunLog& log);

/// Pure: the same sightings, rig and log give exactly the same results, from a video or from a
/// store. `whole_rig` also contains cameras and robots that did not take part.
OrRefusal<AnalysedRun> analyse(Observations observations, const Rig& whole_rig, RunLog log,
                               bool takes_tags_for_centres);
/// Analyses a stored run again.
OrRefusal<AnalysedRun> analyse_again(const RealRunRows& rows);

}  // namespace swarmsmith
