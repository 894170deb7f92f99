#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tracking/observing/observations.h"
#include "tracking/rig/rig.h"
#include "tracking/rig/run_log.h"
#include "tracking/robots/robot_logs.h"
#include "tracking/scoring/scored_run.h"

namespace swarmsmith {

/// The findings on one robot of a run. Missing parts are null.
struct RobotFinding {
  const TrackedRobot* tracked = nullptr;
  const RobotSetup* setup = nullptr;
  const OffsetCalibration* offset = nullptr;
  std::string offset_sha256;  ///< empty if there is no such file
  const BorderDistance* border = nullptr;
  const RobotLog* log = nullptr;
  LogCounts logged;  ///< counts from the log
  const Latency* latency = nullptr;
  const Reality* reality = nullptr;

  std::int64_t cycles(CycleKind kind) const { return std::ranges::count(tracked->cycles, kind); }
  std::int64_t samples(Sample::Use use) const {
    return std::ranges::count(tracked->samples, use, &Sample::use);
  }
  /// Share of its cycles of this kind; 0 without cycles.
  double share(CycleKind kind) const {
    const auto all = static_cast<double>(tracked->cycles.size());
    return all == 0 ? 0 : static_cast<double>(cycles(kind)) / all;
  }
};

/// The findings on a floor tag over a run.
struct ReferenceFinding {
  int tag = 0;
  std::int64_t looks = 0;            ///< number of spans of some seconds in which it was seen
  double rms_px = 0;                 ///< its reprojection error in the place calibration
  std::optional<double> left_out_m;  ///< its floor error when the place was solved without it
  double worst_shift_px = 0;         ///< largest mean shift of its corners since the calibration
};

/// The findings on one camera and its floor tags over a run. Missing parts are null.
struct CameraFinding {
  const CameraRecord* record = nullptr;
  const CameraSetup* setup = nullptr;
  const CameraCalibration* calibration = nullptr;
  std::string calibration_sha256;  ///< empty if there is no such file
  const PlaceCalibration* place = nullptr;
  std::string place_sha256;  ///< empty if there is no such file
  std::vector<ReferenceFinding> references;
  std::int64_t looks = 0;       ///< number of spans in which any floor tag was seen
  double worst_shift_px = 0;    ///< largest of the spans' median shifts of its tags
  double worst_shift_at_s = 0;  ///< on the camera's clock
  std::optional<double> height_m;
};

/// A person's decision on a run, which replaces the computed verdict.
struct VerdictOverride {
  Verdict verdict = Verdict::Valid;
  std::string who;
  std::string reason;
  bool counts = true;  ///< false: another decision or another scoring came later
};

/// The decision that counts; null if there is none.
inline const VerdictOverride* overriding(const std::vector<VerdictOverride>& overrides) {
  const auto last = std::ranges::find(overrides, true, &VerdictOverride::counts);
  return last == overrides.end() ? nullptr : &*last;
}

/// All findings on a scored run, computed once for text, JSON, pages and rows of stores.
struct RunFindings {
  const Rig& rig;  ///< contains only the cameras and robots of the run
  const RunLog& log;
  const Observations& observations;
  const TrackedRun& tracked;
  const ScoredRun& scored;
  std::vector<RobotFinding> robots = {};        ///< in the order of `tracked`
  std::vector<CameraFinding> cameras = {};      ///< in the order of `observations`
  std::vector<VerdictOverride> overrides = {};  ///< oldest first; at most one counts
  std::string program = {};  ///< the scoring program, with the versions of its libraries

  /// The verdict that counts: the override that does, or the computed verdict.
  Verdict verdict() const {
    const VerdictOverride* by_person = overriding(overrides);
    return by_person == nullptr ? scored.verdict : by_person->verdict;
  }
};

/// The arguments must outlive the findings, and must not be moved.
RunFindings findings_of(const Rig& rig, const RunLog& log, const Observations& observations,
                        const TrackedRun& tracked, const ScoredRun& scored);

}  // namespace swarmsmith
