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

/// One robot of a run. What it does not have is null.
struct RobotFinding {
  const TrackedRobot* tracked = nullptr;
  const RobotSetup* setup = nullptr;
  const OffsetCalibration* offset = nullptr;
  std::string offset_sha256;  ///< empty: there is no such file
  const BorderDistance* border = nullptr;
  const RobotLog* log = nullptr;
  LogCounts logged;  ///< of the log
  const Latency* latency = nullptr;
  const Reality* reality = nullptr;

  std::int64_t cycles(CycleKind kind) const { return std::ranges::count(tracked->cycles, kind); }
  std::int64_t samples(Sample::Use use) const {
    return std::ranges::count(tracked->samples, use, &Sample::use);
  }
  /// Part of its cycles; 0 when there are none.
  double share(CycleKind kind) const {
    const auto all = static_cast<double>(tracked->cycles.size());
    return all == 0 ? 0 : static_cast<double>(cycles(kind)) / all;
  }
};

/// A floor tag through a run.
struct ReferenceFinding {
  int tag = 0;
  std::int64_t looks = 0;            ///< spans of some seconds in which it was seen
  double rms_px = 0;                 ///< reprojection, of the place calibration
  std::optional<double> left_out_m;  ///< floor error when the place was solved without it
  double worst_shift_px = 0;         ///< mean of its corners in this run, against the calibration
};

/// One camera and its floor tags through a run. What it does not have is null.
struct CameraFinding {
  const CameraRecord* record = nullptr;
  const CameraSetup* setup = nullptr;
  const CameraCalibration* calibration = nullptr;
  std::string calibration_sha256;  ///< empty: there is no such file
  const PlaceCalibration* place = nullptr;
  std::string place_sha256;  ///< likewise
  std::vector<ReferenceFinding> references;
  std::int64_t looks = 0;       ///< spans with any floor tag
  double worst_shift_px = 0;    ///< largest over the spans of the median shift of its tags
  double worst_shift_at_s = 0;  ///< on the camera's clock
  std::optional<double> height_m;
};

/// A person's word on a run, above the verdict.
struct VerdictOverride {
  Verdict verdict = Verdict::Valid;
  std::string who;
  std::string reason;
};

/// All that is known of a scored run, counted once: text, JSON, pages and rows of stores show it.
struct RunFindings {
  const Rig& rig;  ///< with the cameras and robots of the run alone
  const RunLog& log;
  const Observations& observations;
  const TrackedRun& tracked;
  const ScoredRun& scored;
  std::vector<RobotFinding> robots = {};        ///< as `tracked`
  std::vector<CameraFinding> cameras = {};      ///< as `observations`
  std::vector<VerdictOverride> overrides = {};  ///< oldest first; the last one counts
  std::string program = {};  ///< what scored it, with the versions of its libraries

  /// The verdict that counts.
  Verdict verdict() const { return overrides.empty() ? scored.verdict : overrides.back().verdict; }
};

/// The parts must live as long as the findings, and stay where they are.
RunFindings findings_of(const Rig& rig, const RunLog& log, const Observations& observations,
                        const TrackedRun& tracked, const ScoredRun& scored);

}  // namespace swarmsmith
