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

/// A run: its sightings and known facts, and all that follows from them.
struct AnalysedRun {
  Rig rig;  ///< the cameras and robots of the run alone
  RunLog log;
  Observations observations;
  std::vector<double> starts_s;  ///< of the run, on each camera's clock
  TrackedRun tracked;
  ScoredRun scored;

  /// By this program. The run must live as long, and stay where it is.
  RunFindings findings() const;
  /// The run as rows, with candidate, report and program.
  RealRunRows rows(const std::string& arena_text, CandidateId candidate) const;
};

/// Pure: the same sightings, rig and log give the same bits, from a video or from a store.
/// `whole_rig` also has the cameras and robots that stood by.
OrRefusal<AnalysedRun> analyse(Observations observations, const Rig& whole_rig, RunLog log,
                               bool takes_tags_for_centres);
/// The run of a store, once more.
OrRefusal<AnalysedRun> analyse_again(const RealRunRows& rows);

}  // namespace swarmsmith
