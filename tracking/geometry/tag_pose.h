#pragma once

#include <array>

#include "sim/mission/pose.h"
#include "tracking/geometry/view.h"

namespace swarmsmith {

/// Corners of a tag's black border in an image, in the order of the apriltag library: bottom left,
/// bottom right, top right, top left of the upright tag.
using TagCorners = std::array<ImagePoint, 4>;

/// The pose of a tag on a plane, from its four corners there.
struct TagPose {
  Pose pose;              ///< of the tag's centre; the heading is its x axis, left to right
  double scale = 1;       ///< measured edge divided by declared edge
  double residual_m = 0;  ///< root mean square distance of the corners from the rigid fit
};

/// Intersects the rays through the four corners with the plane at the tag's height, and fits a
/// rigid square in that plane (tracking facts, section 4). A fit with six degrees of freedom is not
/// used, because errors of depth and tilt would affect x and y.
TagPose tag_pose(const View& view, const TagCorners& corners, double edge_m, double height_m);

/// The pose of a tag on its robot: tag = robot + offset (x, y) rotated by the tag's heading, and
/// the tag's heading is the robot's heading plus `yaw` (tracking facts, section 5).
struct TagOffset {
  double x_m = 0;  ///< from the robot's origin to the tag's centre, in the tag's own axes
  double y_m = 0;
  double yaw_rad = 0;

  friend bool operator==(const TagOffset&, const TagOffset&) = default;
};

/// The pose of the robot that carries a tag; its heading is in (-pi, pi].
Pose robot_pose(const Pose& tag, const TagOffset& offset);
/// The inverse of robot_pose, for renderers and tests.
Pose tag_pose_of_robot(const Pose& robot, const TagOffset& offset);

}  // namespace swarmsmith
