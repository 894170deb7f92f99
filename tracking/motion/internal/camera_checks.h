#pragma once

#include <span>
#include <vector>

#include "tracking/motion/internal/robot_samples.h"
#include "tracking/motion/repeats.h"

namespace swarmsmith {

/// The findings about a run that follow from the cameras' frames alone, without the robots.
struct FrameReport {
  double from_s = 0;  ///< in the run: from the first frame of any camera
  double to_s = 0;
  double covered_s = 0;
  bool covers_the_end = false;  ///< some camera has a frame at the end or later
  double frame_rate_least = 0;
  double frame_rate_median = 0;
  double frame_rate_most = 0;
  std::int64_t frames = 0;  ///< during the run
  std::int64_t dropped = 0;
  std::int64_t twice = 0;
  std::vector<double> times;  ///< times of all frames of all cameras, sorted
  std::vector<Issue> issues;
  std::vector<Check> checks;
};

/// Checks coverage, frame rate, dropped and repeated frames, the film's clock, and whether a camera
/// was moved. `repeats` has one entry per camera; repeated frames count as missing.
FrameReport frame_report(const Observations& observations, std::span<const TrackedCamera> cameras,
                         std::span<const Repeats> repeats, const Rig& rig,
                         const TrackOptions& options);

}  // namespace swarmsmith
