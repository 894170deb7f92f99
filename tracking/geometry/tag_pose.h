#pragma once

#include <array>

#include "sim/mission/pose.h"
#include "tracking/geometry/view.h"

namespace swarmsmith {

/// Corners of a tag's black border in an image, in the order of the apriltag library: bottom left,
/// bottom right, top right, top left of the upright tag.
using TagCorners = std::array<ImagePoint, 4>;

/// A tag on a plane, from its four corners there.
struct TagPose {
  Pose pose;              ///< of the tag's middle; the heading is its x axis, left to right
  double scale = 1;       ///< its edge as measured over its edge as declared
  double residual_m = 0;  ///< root mean square of the corners about the rigid fit
};

/// Rays through the four corners, cut with the plane of the tag's height, and a rigid fit in that
/// plane (tracking facts, section 4). No six degrees of freedom: depth and tilt would leak into x
/// and y.
TagPose tag_pose(const View& view, const TagCorners& corners, double edge_m, double height_m);

/// Where a tag sits on its robot: tag = robot + turned by the tag's heading (x, y), and the tag's
/// heading is the robot's plus `yaw` (tracking facts, section 5).
struct TagOffset {
  double x_m = 0;  ///< from the robot's origin to the tag's middle, in the tag's own axes
  double y_m = 0;
  double yaw_rad = 0;

  friend bool operator==(const TagOffset&, const TagOffset&) = default;
};

/// The robot that carries the tag; its heading in (-pi, pi].
Pose robot_pose(const Pose& tag, const TagOffset& offset);
/// The other way round, for renderers and tests.
Pose tag_pose_of_robot(const Pose& robot, const TagOffset& offset);

}  // namespace swarmsmith
