#include "tracking/geometry/camera_model.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

namespace swarmsmith {
namespace {

cv::Matx33d matrix_of(const CameraModel& camera) {
  return {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
}

std::vector<double> coefficients_of(const CameraModel& camera) {
  const auto count = camera.lens == Lens::Fisheye ? 4 : 5;
  return {camera.distortion.begin(), camera.distortion.begin() + count};
}

/// The library's default of five steps does not converge in the corners of a wide-angle lens.
const cv::TermCriteria kConverged(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-12);

/// The derivative of the distorted radius with respect to the radius r (pinhole) or the angle r
/// (fisheye) of a ray.
double slope(const CameraModel& camera, double r) {
  const auto& k = camera.distortion;
  const double q = r * r;
  if (camera.lens == Lens::Fisheye) {
    return 1 + q * (3 * k[0] + q * (5 * k[1] + q * (7 * k[2] + q * 9 * k[3])));
  }
  return 1 + q * (3 * k[0] + q * (5 * k[1] + q * 7 * k[4]));
}

double distorted(const CameraModel& camera, double r) {
  const auto& k = camera.distortion;
  const double q = r * r;
  if (camera.lens == Lens::Fisheye) {
    return r * (1 + q * (k[0] + q * (k[1] + q * (k[2] + q * k[3]))));
  }
  return r * (1 + q * (k[0] + q * (k[1] + q * k[4])));
}

}  // namespace

std::vector<Ray> rays_of(const CameraModel& camera, std::span<const ImagePoint> points) {
  if (points.empty()) return {};
  std::vector<cv::Point2d> from;
  from.reserve(points.size());
  for (const ImagePoint& point : points)
    from.emplace_back(point.u, point.v);
  std::vector<cv::Point2d> to;
  if (camera.lens == Lens::Fisheye) {
    cv::fisheye::undistortPoints(from, to, matrix_of(camera), coefficients_of(camera),
                                 cv::noArray(), cv::noArray(), kConverged);
  } else {
    cv::undistortPoints(from, to, matrix_of(camera), coefficients_of(camera), cv::noArray(),
                        cv::noArray(), kConverged);
  }
  std::vector<Ray> rays;
  rays.reserve(to.size());
  for (const cv::Point2d& point : to)
    rays.push_back({point.x, point.y});
  return rays;
}

ImagePoint image_of(const CameraModel& camera, const Point3& point) {
  const std::vector<cv::Point3d> from{{point.x, point.y, point.z}};
  const cv::Vec3d none(0, 0, 0);
  std::vector<cv::Point2d> to;
  if (camera.lens == Lens::Fisheye) {
    cv::fisheye::projectPoints(from, to, none, none, matrix_of(camera), coefficients_of(camera));
  } else {
    cv::projectPoints(from, none, none, matrix_of(camera), coefficients_of(camera), to);
  }
  return {to.front().x, to.front().y};
}

bool is_monotonic(const CameraModel& camera) {
  // The radius to be checked is the distance of the farthest corner.
  const double far_u = std::max(camera.cx, camera.size.width - 1 - camera.cx) / camera.fx;
  const double far_v = std::max(camera.cy, camera.size.height - 1 - camera.cy) / camera.fy;
  const double wanted = std::hypot(far_u, far_v);
  constexpr double kStep = 0.001;
  constexpr double kMost = 10;
  double r = 0;
  while (r < kMost) {
    // Where the radius stops growing, two rays share a pixel, and `rays_of` has no single answer.
    if (slope(camera, r) <= 0) return false;
    if (distorted(camera, r) >= wanted) return true;
    r += kStep;
  }
  return false;
}

}  // namespace swarmsmith
