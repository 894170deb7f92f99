#pragma once

#include <span>
#include <utility>
#include <vector>

#include "tracking/motion/internal/camera_checks.h"
#include "tracking/motion/internal/precision.h"

namespace swarmsmith {

/// Where a robot was at the start and at the end of each cycle.
struct RobotTrack {
  std::vector<Pose> poses;        ///< cycle 0, which is the start, and all cycles
  std::vector<CycleKind> kinds;   ///< the same
  std::vector<Scatter> sigmas;    ///< the same, systematic parts included
  std::vector<TimedPose> merged;  ///< samples of all cameras that were used, by time
  std::vector<double> by_hand_s;  ///< when a person said where it was; among the merged
  /// Neighbours in one camera's track whose second cannot be reached from the first.
  std::vector<std::pair<TimedPose, TimedPose>> breaks;
  Scatter sigma;  ///< of one camera's sample, systematic parts included
  Scatter noise;  ///< the same without them
  /// Cycles at which two cameras measured it more than `kDisagree_m` apart.
  int disagreeing = 0;
  int compared = 0;  ///< cycles at which two cameras measured it
  double worst_disagreement_m = 0;
  double worst_disagreement_at_s = 0;
};

inline constexpr double kDisagree_m = 0.010;

/// Each camera's samples are brought to the instants on their own; what cameras measured is then
/// fused, weighted by the inverse squares of the sigmas that it has there. Only where none
/// measured, the samples of all cameras together bridge the gap. There must be a used sample.
RobotTrack track_of(const TaggedRobot& robot, const RobotSamples& samples,
                    std::span<const TrackedCamera> cameras, const TrackOptions& options);

/// The robot's part of the run, what is wrong with it, and what was asked.
TrackedRobot tracked_robot(const TaggedRobot& robot, RobotSamples samples, const RobotTrack& track,
                           const FrameReport& frames, const TrackOptions& options,
                           std::vector<Issue>& issues, std::vector<Check>& checks);

}  // namespace swarmsmith
