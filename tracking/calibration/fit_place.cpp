#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <optional>

#include "tracking/calibration/solve_place.h"

namespace swarmsmith {
namespace {

using Vector6 = cv::Matx61d;  ///< Rodrigues vector and translation

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

/// Seen minus expected, u and v of each corner; nothing when a corner would be behind the camera.
std::optional<std::vector<double>> residuals_of(const Corners& corners, const CameraModel& camera,
                                                const Vector6& pose) {
  const CameraPlace place = place_of(pose);
  std::vector<double> residuals;
  residuals.reserve(2 * corners.seen.size());
  for (std::size_t i = 0; i < corners.seen.size(); ++i) {
    const cv::Point3d& p = corners.world[i];
    const Point3 seen = place.seen_from_camera({p.x, p.y, p.z});
    if (!(seen.z > 1e-6)) return std::nullopt;
    const ImagePoint expected = image_of(camera, seen);
    residuals.push_back(corners.seen[i].u - expected.u);
    residuals.push_back(corners.seen[i].v - expected.v);
  }
  return residuals;
}

double squares_of(const std::vector<double>& residuals) {
  double squares = 0;
  for (const double residual : residuals)
    squares += residual * residual;
  return squares;
}

/// Normal equations at a pose, by central differences.
bool linearise(const Corners& corners, const CameraModel& camera, const Vector6& pose,
               const std::vector<double>& residuals, cv::Matx66d& normal, Vector6& right) {
  constexpr double kStep = 1e-6;
  std::vector<std::vector<double>> slopes;
  for (int k = 0; k < 6; ++k) {
    Vector6 ahead = pose;
    Vector6 behind = pose;
    ahead(k) += kStep;
    behind(k) -= kStep;
    const auto a = residuals_of(corners, camera, ahead);
    const auto b = residuals_of(corners, camera, behind);
    if (!a || !b) return false;
    auto& slope = slopes.emplace_back();
    for (std::size_t i = 0; i < residuals.size(); ++i)
      slope.push_back(((*a)[i] - (*b)[i]) / (2 * kStep));
  }
  for (int j = 0; j < 6; ++j) {
    const auto& sj = slopes[static_cast<std::size_t>(j)];
    right(j) = 0;
    for (std::size_t i = 0; i < residuals.size(); ++i)
      right(j) -= sj[i] * residuals[i];
    for (int k = 0; k < 6; ++k) {
      const auto& sk = slopes[static_cast<std::size_t>(k)];
      normal(j, k) = 0;
      for (std::size_t i = 0; i < residuals.size(); ++i)
        normal(j, k) += sj[i] * sk[i];
    }
  }
  return true;
}

/// Levenberg and Marquardt from a start; nothing when the start sees corners behind the camera.
std::optional<PlaceFit> refined(const Corners& corners, const CameraModel& camera, Vector6 pose) {
  auto residuals = residuals_of(corners, camera, pose);
  if (!residuals) return std::nullopt;
  double squares = squares_of(*residuals);
  double damping = 1e-3;
  constexpr int kMostSteps = 100;
  for (int step = 0; step < kMostSteps && damping < 1e9; ++step) {
    cv::Matx66d normal;
    Vector6 right;
    if (!linearise(corners, camera, pose, *residuals, normal, right)) break;
    for (int k = 0; k < 6; ++k)
      normal(k, k) *= 1 + damping;
    Vector6 move;
    if (!cv::solve(normal, right, move, cv::DECOMP_CHOLESKY)) break;
    const Vector6 next = pose + move;
    const auto moved = residuals_of(corners, camera, next);
    if (!moved || !(squares_of(*moved) < squares)) {
      damping *= 10;
      continue;
    }
    const double gain = squares - squares_of(*moved);
    pose = next;
    residuals = moved;
    squares -= gain;
    damping = std::max(damping / 10, 1e-12);
    if (gain < 1e-14 * squares || cv::norm(move) < 1e-13) break;
  }
  squares = squares_of(*residuals);
  if (!std::isfinite(squares)) return std::nullopt;
  return PlaceFit{place_of(pose), std::sqrt(squares / static_cast<double>(corners.seen.size()))};
}

/// Rough places, on the undistorted rays.
std::vector<Vector6> starts_of(const Corners& corners, const CameraModel& camera) {
  std::vector<cv::Point2d> rays;
  for (const Ray& ray : rays_of(camera, corners.seen))
    rays.emplace_back(ray.x, ray.y);
  std::vector<Vector6> starts;
  for (const auto method : {cv::SOLVEPNP_IPPE, cv::SOLVEPNP_SQPNP}) {
    std::vector<cv::Mat> turns;
    std::vector<cv::Mat> shifts;
    try {
      cv::solvePnPGeneric(corners.world, rays, cv::Matx33d::eye(), cv::noArray(), turns, shifts,
                          false, method);
    } catch (const cv::Exception&) {
      // Corners that no plane is seen so; the other method may still find a start.
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
