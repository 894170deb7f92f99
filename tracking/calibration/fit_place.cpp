#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <optional>

#include "tracking/calibration/solve_place.h"

namespace swarmsmith {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;  ///< Rodrigues vector and translation

struct Corners {
  std::vector<cv::Point3d> world;
  std::vector<ImagePoint> seen;
};

CameraPlace place_of(const Vector6& pose) {
  cv::Matx33d rotation;
  cv::Rodrigues(cv::Vec3d(pose(0), pose(1), pose(2)), rotation);
  CameraPlace place;
  std::copy(std::begin(rotation.val), std::end(rotation.val), place.rotation.begin());
  place.translation = {pose(3), pose(4), pose(5)};
  return place;
}

/// Seen minus expected, u and v of each corner; nothing if a corner is behind the camera.
std::optional<Eigen::VectorXd> residuals_of(const Corners& corners, const CameraModel& camera,
                                            const Vector6& pose) {
  const CameraPlace place = place_of(pose);
  Eigen::VectorXd residuals(2 * static_cast<Eigen::Index>(corners.seen.size()));
  for (std::size_t i = 0; i < corners.seen.size(); ++i) {
    const cv::Point3d& p = corners.world[i];
    const Point3 seen = place.seen_from_camera({p.x, p.y, p.z});
    if (!(seen.z > 1e-6)) return std::nullopt;
    const ImagePoint expected = image_of(camera, seen);
    residuals.segment<2>(2 * static_cast<Eigen::Index>(i)) << corners.seen[i].u - expected.u,
        corners.seen[i].v - expected.v;
  }
  return residuals;
}

/// The derivatives of the residuals with respect to the pose, by central differences.
using Slopes = Eigen::Matrix<double, Eigen::Dynamic, 6>;
std::optional<Slopes> slopes_of(const Corners& corners, const CameraModel& camera,
                                const Vector6& pose) {
  constexpr double kStep = 1e-6;
  Slopes slopes(2 * static_cast<Eigen::Index>(corners.seen.size()), 6);
  for (int k = 0; k < 6; ++k) {
    const auto ahead = residuals_of(corners, camera, pose + kStep * Vector6::Unit(k));
    const auto behind = residuals_of(corners, camera, pose - kStep * Vector6::Unit(k));
    if (!ahead || !behind) return std::nullopt;
    slopes.col(k) = (*ahead - *behind) / (2 * kStep);
  }
  return slopes;
}

/// Refines a start with the Levenberg-Marquardt method; nothing if a corner is behind the camera at
/// the start.
std::optional<PlaceFit> refined(const Corners& corners, const CameraModel& camera, Vector6 pose) {
  auto residuals = residuals_of(corners, camera, pose);
  if (!residuals) return std::nullopt;
  double squares = residuals->squaredNorm();
  double damping = 1e-3;
  constexpr int kMostSteps = 100;
  for (int step = 0; step < kMostSteps && damping < 1e9; ++step) {
    const auto slopes = slopes_of(corners, camera, pose);
    if (!slopes) break;
    Eigen::Matrix<double, 6, 6> normal = slopes->transpose() * *slopes;
    normal.diagonal() *= 1 + damping;
    const Eigen::LLT<Eigen::Matrix<double, 6, 6>> factors(normal);
    if (factors.info() != Eigen::Success) break;
    const Vector6 move = factors.solve(-(slopes->transpose() * *residuals));
    const auto moved = residuals_of(corners, camera, pose + move);
    if (!moved || !(moved->squaredNorm() < squares)) {
      damping *= 10;
      continue;
    }
    const double gain = squares - moved->squaredNorm();
    pose += move;
    residuals = moved;
    squares -= gain;
    damping = std::max(damping / 10, 1e-12);
    if (gain < 1e-14 * squares || move.norm() < 1e-13) break;
  }
  squares = residuals->squaredNorm();
  if (!std::isfinite(squares)) return std::nullopt;
  return PlaceFit{place_of(pose), std::sqrt(squares / static_cast<double>(corners.seen.size()))};
}

/// Approximate places, from the undistorted rays.
std::vector<Vector6> starts_of(const Corners& corners, const CameraModel& camera) {
  std::vector<cv::Point2d> rays;
  for (const Ray& ray : rays_of(camera, corners.seen))
    rays.emplace_back(ray.x, ray.y);
  std::vector<Vector6> starts;
  // A plane seen from far away has two poses with similar errors. IPPE (Collins and Bartoli 2014)
  // returns both; all starts are refined, and `fit_place` takes the best.
  for (const auto method : {cv::SOLVEPNP_IPPE, cv::SOLVEPNP_SQPNP}) {
    std::vector<cv::Mat> turns;
    std::vector<cv::Mat> shifts;
    try {
      cv::solvePnPGeneric(corners.world, rays, cv::Matx33d::eye(), cv::noArray(), turns, shifts,
                          false, method);
    } catch (const std::exception&) {
      // No plane can be seen like this; the other method may still find a start.
      continue;
    }
    for (std::size_t i = 0; i < turns.size(); ++i) {
      Vector6 start;
      for (int k = 0; k < 3; ++k) {
        start(k) = turns[i].at<double>(k);
        start(k + 3) = shifts[i].at<double>(k);
      }
      starts.push_back(start);
    }
  }
  return starts;
}

}  // namespace

std::optional<PlaceFit> fit_place(std::span<const SeenTag> seen, const CameraModel& camera) {
  if (seen.size() < 2) return std::nullopt;
  Corners corners;
  for (const SeenTag& tag : seen) {
    for (const Point& corner : corners_of(tag.tag))
      corners.world.emplace_back(corner.x, corner.y, 0.0);
    corners.seen.insert(corners.seen.end(), tag.corners.begin(), tag.corners.end());
  }
  std::optional<PlaceFit> best;
  for (const Vector6& start : starts_of(corners, camera)) {
    const auto fit = refined(corners, camera, start);
    if (!fit || !(fit->place.centre().z > 0)) continue;
    if (!best || fit->rms_px < best->rms_px) best = fit;
  }
  return best;
}

}  // namespace swarmsmith
