#pragma once

#include <array>
#include <cmath>

#include "tracking/geometry/tag_pose.h"

namespace swarmsmith {

/// The lens that tracking facts were measured with.
inline CameraModel wide_camera() {
  return {
      {1920, 1080}, Lens::Pinhole, 1015, 1015, 959.5, 539.5, {-0.285, 0.08, 0.0005, -0.0003, 0}};
}

/// A rotation about the x axis, then y, then z, radians; row by row.
inline std::array<double, 9> rotation_about(double x, double y, double z) {
  const double cx = std::cos(x);
  const double sx = std::sin(x);
  const double cy = std::cos(y);
  const double sy = std::sin(y);
  const double cz = std::cos(z);
  const double sz = std::sin(z);
  return {cz * cy,
          cz * sy * sx - sz * cx,
          cz * sy * cx + sz * sx,
          sz * cy,
          sz * sy * sx + cz * cx,
          sz * sy * cx - cz * sx,
          -sy,
          cy * sx,
          cy * cx};
}

/// The corners of a tag that lies on a plane, as a camera sees them.
inline TagCorners seen_corners(const View& view, const Pose& tag, double edge_m, double height_m) {
  constexpr std::array<Point, 4> kModel{{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}};
  const double c = std::cos(tag.theta);
  const double s = std::sin(tag.theta);
  TagCorners corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double x = kModel[i].x * edge_m;
    const double y = kModel[i].y * edge_m;
    corners[i] = image_of(view, Point3{tag.x + c * x - s * y, tag.y + s * x + c * y, height_m});
  }
  return corners;
}

}  // namespace swarmsmith
