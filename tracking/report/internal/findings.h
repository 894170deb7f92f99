#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "tracking/report/quality.h"

namespace swarmsmith {

/// What a report counts and measures beyond what tracking already has.

/// Control cycles of a robot by kind.
struct CycleCounts {
  std::int64_t measured = 0;
  std::int64_t interpolated = 0;
  std::int64_t degraded = 0;
  std::int64_t missing = 0;

  std::int64_t all() const { return measured + interpolated + degraded + missing; }
};
CycleCounts cycle_counts(const TrackedRobot& robot);

/// Samples of a robot by what became of them.
std::map<Sample::Use, std::int64_t> sample_counts(const TrackedRobot& robot);

/// A floor tag through a run.
struct ReferenceFinding {
  int tag = 0;
  std::int64_t looks = 0;            ///< spans of some seconds in which it was seen
  double rms_px = 0;                 ///< reprojection, of the place calibration
  std::optional<double> left_out_m;  ///< floor error when the place was solved without it
  double worst_shift_px = 0;         ///< mean of its corners in this run, against the calibration
};

/// A camera and its floor tags through a run.
struct CameraFinding {
  const CameraSetup* setup = nullptr;              ///< null when the rig has no such camera
  const CameraCalibration* calibration = nullptr;  ///< null when there is none
  const PlaceCalibration* place = nullptr;
  std::vector<ReferenceFinding> references;
  std::int64_t looks = 0;       ///< spans with any floor tag
  double worst_shift_px = 0;    ///< largest over the spans of the median shift of its tags
  double worst_shift_at_s = 0;  ///< on the camera's clock
  std::optional<double> height_m;
};
CameraFinding camera_finding(const ReportedRun& run, const CameraRecord& record);

/// The log of a robot, by its number; null when it has none.
const RobotLog* log_of(const ReportedRun& run, std::size_t robot);

/// The verdict that counts.
Verdict counting_verdict(const ReportedRun& run);

}  // namespace swarmsmith
