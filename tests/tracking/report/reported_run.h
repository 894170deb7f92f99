#pragma once

#include "tracking/report/quality.h"

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
  ReportedRun reported() const {
    return {rig, log, observations, tracked, scored, {}, overrides, "swarmsmith-track 0.1.0"};
  }
};

}  // namespace swarmsmith
