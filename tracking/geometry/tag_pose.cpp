#include "tracking/geometry/tag_pose.h"

#include <cmath>

#include "base/math.h"

namespace swarmsmith {

TagPose tag_pose(const View& view, const TagCorners& corners, double edge_m, double height_m) {
  const double half = edge_m / 2;
  const std::array<Point, 4> model{{{-half, -half}, {half, -half}, {half, half}, {-half, half}}};
  const std::vector<Point> found = on_plane(view, corners, height_m);
  Point middle;
  for (const Point& point : found) {
    middle.x += point.x / 4;
    middle.y += point.y / 4;
  }
  double along = 0;
  double across = 0;
  double spread = 0;
  for (std::size_t i = 0; i < model.size(); ++i) {
    const Point q{found[i].x - middle.x, found[i].y - middle.y};
    along += model[i].x * q.x + model[i].y * q.y;
    across += model[i].x * q.y - model[i].y * q.x;
    spread += q.x * q.x + q.y * q.y;
  }
  const double length = std::hypot(along, across);
  const double model_spread = 2 * edge_m * edge_m;
  // Squared residuals of the rigid fit, which does not use the scale of the best similarity.
  const double squares = spread + model_spread - 2 * length;
  return {{middle.x, middle.y, std::atan2(across, along)},
          length / model_spread,
          std::sqrt(std::max(0.0, squares / 4))};
}

Pose robot_pose(const Pose& tag, const TagOffset& offset) {
  const double c = std::cos(tag.theta);
  const double s = std::sin(tag.theta);
  return {tag.x - (c * offset.x_m - s * offset.y_m), tag.y - (s * offset.x_m + c * offset.y_m),
          wrap_angle(tag.theta - offset.yaw_rad)};
}

Pose tag_pose_of_robot(const Pose& robot, const TagOffset& offset) {
  const double theta = wrap_angle(robot.theta + offset.yaw_rad);
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  return {robot.x + c * offset.x_m - s * offset.y_m, robot.y + s * offset.x_m + c * offset.y_m,
          theta};
}

}  // namespace swarmsmith
