#pragma once

#include <span>

#include "tracking/motion/track_run.h"

namespace swarmsmith {

/// From samples at the instants of frames to poses at the instants of the simulator.

/// The global instant that ends a control cycle; cycle 0 is the start. The simulator's own instants
/// (tracking facts, section 7).
inline double instant_s(int cycle) {
  return cycle * kControlPeriod_s;
}

/// Times nearer than this are one: what is left of a clock's offset when it is subtracted.
inline constexpr double kSameInstant_s = 1e-6;

/// A robot's centre at a time of the run.
struct TimedPose {
  double time_s = 0;
  Pose pose;
};

/// Whether a robot can have come from the one to the other, `from` first, at the limits' speed and
/// turn. A few millimetres and a degree are allowed for noise between frames that follow closely.
bool is_reachable(const TimedPose& from, const TimedPose& to, const TrackLimits& limits);

/// A pose at an instant and what it was made of.
struct PoseAt {
  Pose pose;
  CycleKind kind = CycleKind::Missing;
  double gap_s = 0;  ///< between the neighbours; 0 on a sample, and with one neighbour only
};

/// The pose between the two neighbours of an instant: position along the straight line, heading
/// along the shorter arc; a sample at the instant itself gives its own bits. Missing, and the last
/// known pose (before the first sample that one), where there is nothing to interpolate between:
/// one neighbour only, more than `degraded_gap_s`, or ends that the robot cannot have reached.
/// Never extrapolates. `track` is sorted by time and not empty.
PoseAt pose_at(std::span<const TimedPose> track, double time_s, const TrackLimits& limits);

}  // namespace swarmsmith
