#pragma once

#include <span>
#include <vector>

#include "base/expected.h"
#include "tracking/geometry/tag_pose.h"
#include "tracking/rig/rig.h"

namespace swarmsmith {

/// A tag at a time, on the floor's plane.
struct TagSample {
  double time_s = 0;
  Pose tag;
};

/// Where the tag sits on a robot that turns on the spot, by linear least squares: the tag is at
/// centre + drift * time + turned by its heading (x, y), six unknowns; residuals beyond three
/// sigma are trimmed and the rest is fitted again (tracking facts, section 5). Samples in the order
/// of time. Gives offset without yaw, rms, sigmas, drift, turn and samples; whether that is good
/// enough is for faults_of.
///
/// E_SPIN_QUALITY when the samples leave the six unknowns open.
Expected<OffsetCalibration> solve_offset(std::span<const TagSample> samples);

/// The tag's heading minus the robot's, from a straight run: the circular mean of heading minus
/// direction of travel of the robot's centre.
struct TravelYaw {
  double yaw_rad = 0;
  double spread_rad = 0;  ///< circular standard deviation
  double length_m = 0;    ///< of the way from first to last sample
};

/// `reverse`: the robot drove backwards. E_SPIN_QUALITY: less than 0.5 m, or not straight.
Expected<TravelYaw> solve_yaw(std::span<const TagSample> samples, const TagOffset& offset,
                              bool reverse);

}  // namespace swarmsmith
