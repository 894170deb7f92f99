#pragma once

#include <span>
#include <vector>

#include "base/expected.h"
#include "tracking/geometry/tag_pose.h"
#include "tracking/rig/rig.h"

namespace swarmsmith {

/// The pose of a tag at a time, on the plane of the floor.
struct TagSample {
  double time_s = 0;
  Pose tag;
};

/// Finds the position of the tag on a robot that turns on the spot, by linear least squares with
/// six unknowns: the tag is at centre + drift * time + offset (x, y) rotated by its heading.
/// Residuals beyond three sigma are dropped and the rest is fitted again (tracking facts, section
/// 5). Samples are in order of time. The result has offset without yaw, rms, sigmas, drift, turn
/// and samples; faults_of decides whether it is good enough.
///
/// E_SPIN_QUALITY if the samples do not determine the six unknowns.
Expected<OffsetCalibration> solve_offset(std::span<const TagSample> samples);

/// The tag's heading minus the robot's heading, from a straight run: the circular mean of the tag's
/// heading minus the direction of travel of the robot's centre.
struct TravelYaw {
  double yaw_rad = 0;
  double spread_rad = 0;  ///< circular standard deviation
  double length_m = 0;    ///< distance from first to last sample
};

/// `reverse`: the robot drove backwards. E_SPIN_QUALITY if the run is shorter than 0.5 m or not
/// straight.
Expected<TravelYaw> solve_yaw(std::span<const TagSample> samples, const TagOffset& offset,
                              bool reverse);

}  // namespace swarmsmith
