#pragma once

#include <span>
#include <utility>
#include <vector>

#include "tracking/motion/internal/camera_checks.h"
#include "tracking/motion/internal/precision.h"

namespace swarmsmith {

/// The poses of a robot at the start and at the end of each cycle.
struct RobotTrack {
  std::vector<Pose> poses;         ///< index 0 is the start, then one per cycle
  std::vector<CycleKind> kinds;    ///< in the same order
  std::vector<Scatter> sigmas;     ///< in the same order; with systematic errors
  std::vector<TimedPose> merged;   ///< the used samples of all cameras, by time
  std::vector<double> by_hand_s;   ///< times at which a person marked it; also in `merged`
  std::vector<double> unneeded_s;  ///< the same where a camera saw its tag: not used
  /// Consecutive samples of one camera such that the second cannot be reached from the first.
  std::vector<std::pair<TimedPose, TimedPose>> breaks;
  Scatter sigma;       ///< of one camera's sample, with systematic errors
  double noise_m = 0;  ///< the same of places, without systematic errors
  /// Number of cycles at which the measurements of two cameras are more than `kDisagree_m` apart.
  int disagreeing = 0;
  int compared = 0;  ///< number of cycles at which two cameras measured it
  double worst_disagreement_m = 0;
  double worst_disagreement_at_s = 0;
};

inline constexpr double kDisagree_m = 0.010;

/// The samples of each camera are first interpolated to the instants separately. Then the
/// measurements of all cameras at an instant are fused, weighted by the inverse squares of their
/// sigmas there. If no camera has a measurement, the gap is bridged with the samples of all cameras
/// together. There must be a used sample.
RobotTrack track_of(const TaggedRobot& robot, const RobotSamples& samples,
                    std::span<const TrackedCamera> cameras, const TrackOptions& options);

/// The robot's part of the run; also adds its issues and checks.
TrackedRobot tracked_robot(const TaggedRobot& robot, RobotSamples samples, const RobotTrack& track,
                           const FrameReport& frames, const TrackOptions& options,
                           std::vector<Issue>& issues, std::vector<Check>& checks);

}  // namespace swarmsmith
