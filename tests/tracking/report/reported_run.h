#pragma once

#include "tracking/scoring/run_findings.h"

namespace swarmsmith {

/// A run of aggregation with three robots on circles, with a gap, an outlier and a floor tag that
/// went away: its parts, to be changed by a test.
struct MadeUpRun {
  Rig rig;
  RunLog log;
  Observations observations;
  TrackedRun tracked;
  ScoredRun scored;
  std::vector<VerdictOverride> overrides;

  MadeUpRun();
  RunFindings reported() const {
    RunFindings findings = findings_of(rig, log, observations, tracked, scored);
    findings.overrides = overrides;
    findings.program = "swarmsmith-track 0.1.0";
    return findings;
  }
};

}  // namespace swarmsmith
