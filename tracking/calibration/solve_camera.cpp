#include "tracking/calibration/solve_camera.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <exception>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "base/median.h"
#include "base/plain_text.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kLeastCorners = 8;
constexpr std::size_t kLeastViews = 3;
/// A view this good is never an outlier, however good the others are.
constexpr double kGoodView_px = 0.05;
constexpr double kOutlier = 3;

const cv::TermCriteria kConverged(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 300, 1e-12);

/// The views in OpenCV's types; its pinhole solver only accepts floats.
struct Points {
  std::vector<std::vector<cv::Point3f>> board;
  std::vector<std::vector<cv::Point2f>> seen;
};

/// The result from one start.
struct Fit {
  double rms_px = 0;
  cv::Matx33d matrix;
  std::vector<double> distortion;
  std::vector<cv::Mat> turns;
  std::vector<cv::Mat> shifts;
  double focal_sigma_px = 0;
};

Points points_of(std::span<const BoardView> views, const std::vector<std::size_t>& used) {
  Points points;
  for (const std::size_t i : used) {
    auto& board = points.board.emplace_back();
    auto& seen = points.seen.emplace_back();
    for (const Point& corner : views[i].board)
      board.emplace_back(static_cast<float>(corner.x), static_cast<float>(corner.y), 0.0F);
    for (const ImagePoint& corner : views[i].seen)
      seen.emplace_back(static_cast<float>(corner.u), static_cast<float>(corner.v));
  }
  return points;
}

cv::Matx33d guess(ImageSize size, double focal) {
  return {focal, 0, (size.width - 1) / 2.0, 0, focal, (size.height - 1) / 2.0, 0, 0, 1};
}

/// Starts from a guess of the focal length, or without one from the solver's own start.
Fit fit_pinhole(const Points& points, ImageSize size, std::optional<double> focal) {
  cv::Mat matrix = focal ? cv::Mat(guess(size, *focal)) : cv::Mat::eye(3, 3, CV_64F);
  cv::Mat distortion = cv::Mat::zeros(1, 5, CV_64F);
  cv::Mat sigmas;
  Fit fit;
  fit.rms_px =
      cv::calibrateCamera(points.board, points.seen, {size.width, size.height}, matrix, distortion,
                          fit.turns, fit.shifts, sigmas, cv::noArray(), cv::noArray(),
                          focal ? cv::CALIB_USE_INTRINSIC_GUESS : 0, kConverged);
  fit.matrix = cv::Matx33d(matrix);
  fit.distortion.assign(distortion.begin<double>(), distortion.end<double>());
  fit.focal_sigma_px = std::max(sigmas.at<double>(0), sigmas.at<double>(1));
  return fit;
}

Fit fit_fisheye(const Points& points, ImageSize size, std::optional<double> focal) {
  cv::Mat matrix = focal ? cv::Mat(guess(size, *focal)) : cv::Mat::eye(3, 3, CV_64F);
  cv::Mat distortion = cv::Mat::zeros(1, 4, CV_64F);
  const int flags = cv::fisheye::CALIB_RECOMPUTE_EXTRINSIC | cv::fisheye::CALIB_FIX_SKEW |
                    (focal ? cv::fisheye::CALIB_USE_INTRINSIC_GUESS : 0);
  Fit fit;
  fit.rms_px = cv::fisheye::calibrate(points.board, points.seen, {size.width, size.height}, matrix,
                                      distortion, fit.turns, fit.shifts, flags, kConverged);
  fit.matrix = cv::Matx33d(matrix);
  fit.distortion.assign(distortion.begin<double>(), distortion.end<double>());
  return fit;
}

bool is_finite(const Fit& fit) {
  double sum = fit.rms_px;
  for (const double value : fit.matrix.val)
    sum += value;
  for (const double value : fit.distortion)
    sum += value;
  return std::isfinite(sum) && fit.matrix(0, 0) > 0 && fit.matrix(1, 1) > 0;
}

/// The best result of all starts.
std::optional<Fit> best_fit(const Points& points, ImageSize size, Lens lens) {
  const double width = std::max(size.width, size.height);
  // About 90 and 50 degrees across the width; for a fisheye lens 180 degrees are pi focal lengths.
  const std::vector<std::optional<double>> starts =
      lens == Lens::Fisheye
          ? std::vector<std::optional<double>>{std::nullopt, width / 3.1416, width / 2}
          : std::vector<std::optional<double>>{std::nullopt, width * 0.55, width * 1.1};
  std::optional<Fit> best;
  for (const auto& start : starts) {
    try {
      Fit fit = lens == Lens::Fisheye ? fit_fisheye(points, size, start)
                                      : fit_pinhole(points, size, start);
      if (is_finite(fit) && (!best || fit.rms_px < best->rms_px)) best = std::move(fit);
    } catch (const std::exception&) {
      // This start failed (no camera with the guessed focal length can have one of the views); the
      // other starts may succeed.
    }
  }
  return best;
}

SolvedView view_of(const Points& points, std::size_t i, const Fit& fit, Lens lens) {
  std::vector<cv::Point2f> expected;
  if (lens == Lens::Fisheye) {
    cv::fisheye::projectPoints(points.board[i], expected, fit.turns[i], fit.shifts[i], fit.matrix,
                               fit.distortion);
  } else {
    cv::projectPoints(points.board[i], fit.turns[i], fit.shifts[i], fit.matrix, fit.distortion,
                      expected);
  }
  SolvedView view;
  double squares = 0;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const cv::Point2d off = cv::Point2d(points.seen[i][k]) - cv::Point2d(expected[k]);
    view.residuals.push_back({off.x, off.y});
    squares += off.dot(off);
  }
  view.rms_px = std::sqrt(squares / static_cast<double>(expected.size()));
  return view;
}

/// The used view that must be dropped as an outlier, if there is one.
std::optional<std::size_t> outlier_of(const std::vector<SolvedView>& views,
                                      const std::vector<std::size_t>& used) {
  std::vector<double> all;
  all.reserve(used.size());
  for (const std::size_t i : used)
    all.push_back(views[i].rms_px);
  const double median = upper_median(std::move(all));
  // Only the worst view is dropped before the next fit, because a bad view also changes the errors
  // of the others.
  const std::size_t worst =
      *std::ranges::max_element(used, {}, [&](std::size_t i) { return views[i].rms_px; });
  const double limit = std::max(kOutlier * median, kGoodView_px);
  if (views[worst].rms_px <= limit || used.size() <= kLeastViews) return std::nullopt;
  return worst;
}

void take_fit(const Fit& fit, ImageSize size, Lens lens, CameraCalibration& calibration) {
  CameraModel& model = calibration.model;
  model = {size, lens, fit.matrix(0, 0), fit.matrix(1, 1), fit.matrix(0, 2), fit.matrix(1, 2), {}};
  std::ranges::copy(fit.distortion, model.distortion.begin());
  calibration.rms_px = fit.rms_px;
  calibration.focal_sigma_px = fit.focal_sigma_px;
}

}  // namespace

FrameCoverage coverage_of(std::span<const ImagePoint> corners, ImageSize size) {
  FrameCoverage coverage;
  if (corners.empty()) return coverage;
  const auto third = [](double at, int length) {
    return static_cast<std::size_t>(std::clamp(3 * (at + 0.5) / length, 0.0, 2.0));
  };
  std::vector<cv::Point2f> all;
  for (const ImagePoint& corner : corners) {
    ++coverage.ninths.at(3 * third(corner.v, size.height) + third(corner.u, size.width));
    all.emplace_back(static_cast<float>(corner.u), static_cast<float>(corner.v));
  }
  std::vector<cv::Point2f> hull;
  cv::convexHull(all, hull);
  for (const cv::Point2f& corner : hull)
    coverage.hull.push_back({std::round(10 * static_cast<double>(corner.x)) / 10,
                             std::round(10 * static_cast<double>(corner.y)) / 10});
  coverage.share = cv::contourArea(hull) / (static_cast<double>(size.width) * size.height);
  return coverage;
}

Expected<CameraSolution> solve_camera(std::span<const BoardView> views, ImageSize size, Lens lens) {
  CameraSolution solution;
  solution.views.resize(views.size());
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (views[i].seen.size() >= kLeastCorners) used.push_back(i);
    solution.views[i].dropped = views[i].seen.size() < kLeastCorners;
  }
  if (used.size() < kLeastViews) {
    return Unexpected(
        error_of(IssueCode::CalibrationQuality,
                 fmt::format("only {} at least {} corners of the board, but 10 are needed; "
                             "is the board as described, flat and sharp?",
                             counted(used.size(), "view shows", "views show"), kLeastCorners),
                 ""));
  }
  while (true) {
    const Points points = points_of(views, used);
    const std::optional<Fit> fit = best_fit(points, size, lens);
    if (!fit) {
      return Unexpected(
          error_of(IssueCode::CalibrationQuality,
                   "no camera model fits the views; is the board described correctly, "
                   "and do some views tilt it?",
                   ""));
    }
    for (std::size_t k = 0; k < used.size(); ++k)
      solution.views[used[k]] = view_of(points, k, *fit, lens);
    const auto outlier = outlier_of(solution.views, used);
    if (outlier) {
      solution.views[*outlier].dropped = true;
      ++solution.calibration.views_dropped;
      std::erase(used, *outlier);
      continue;
    }
    take_fit(*fit, size, lens, solution.calibration);
    std::vector<ImagePoint> corners;
    for (const std::size_t i : used)
      corners.insert(corners.end(), views[i].seen.begin(), views[i].seen.end());
    const FrameCoverage coverage = coverage_of(corners, size);
    solution.ninths = coverage.ninths;
    solution.calibration.coverage = coverage.share;
    solution.calibration.hull = coverage.hull;
    break;
  }
  solution.calibration.views = static_cast<int>(used.size());
  for (const std::size_t i : used) {
    solution.calibration.worst_view_px =
        std::max(solution.calibration.worst_view_px, solution.views[i].rms_px);
  }
  return solution;
}

}  // namespace swarmsmith
