#pragma once

#include <span>
#include <vector>

#include "tracking/motion/internal/robot_samples.h"
#include "tracking/motion/repeats.h"

namespace swarmsmith {

/// What the cameras' frames say of a run, robots left aside.
struct FrameReport {
  double from_s = 0;  ///< of the run: what frames of any camera cover
  double to_s = 0;
  double covered_s = 0;
  bool covers_the_end = false;  ///< a frame at the end or after it
  double frame_rate_least = 0;
  double frame_rate_median = 0;
  double frame_rate_most = 0;
  std::int64_t frames = 0;  ///< within the run
  std::int64_t dropped = 0;
  std::int64_t twice = 0;
  std::vector<double> times;  ///< of all frames of all cameras, sorted
  std::vector<Issue> issues;
  std::vector<Check> checks;
};

/// Coverage, frame rate, dropped and repeated frames, what speaks against the film's clock, and
/// whether a camera was moved. `repeats`, one a camera, count as frames that are not there.
FrameReport frame_report(const Observations& observations, std::span<const TrackedCamera> cameras,
                         std::span<const Repeats> repeats, const Rig& rig,
                         const TrackOptions& options);

}  // namespace swarmsmith
