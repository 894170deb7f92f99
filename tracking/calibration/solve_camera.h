#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "base/expected.h"
#include "tracking/geometry/camera_model.h"
#include "tracking/rig/rig.h"

namespace swarmsmith {

/// What a picture shows of a board: corners on the board (metres, its own plane) and in the image.
struct BoardView {
  std::string name;  ///< of the picture
  std::vector<Point> board;
  std::vector<ImagePoint> seen;  ///< as many, in the same order
};

/// How a view fits the solved camera.
struct SolvedView {
  double rms_px = 0;
  bool dropped = false;               ///< as an outlier; its rms is that of when it was dropped
  std::vector<ImagePoint> residuals;  ///< seen minus expected, a corner each
};

/// How corners lie in a frame.
struct FrameCoverage {
  std::array<int, 9> ninths{};   ///< corners in each ninth, by rows
  double share = 0;              ///< of the frame within the corners' hull
  std::vector<ImagePoint> hull;  ///< rounded to a tenth of a pixel
};
FrameCoverage coverage_of(std::span<const ImagePoint> corners, ImageSize size);

struct CameraSolution {
  CameraCalibration calibration;  ///< without board and date
  std::vector<SolvedView> views;  ///< one a view that was given
  std::array<int, 9> ninths{};    ///< corners of used views in each ninth of the frame, by rows
};

/// The intrinsics that explain the views best, by OpenCV's solvers run until they have converged:
/// up to 300 iterations to a step of 1e-12, from starts without and with a guess; the
/// lowest RMS is kept; the worst view goes, and all is solved again, as long as its RMS is above
/// three times the median (tracking facts, section 2: the default of 30 iterations gives a wrong
/// focal length that still looks fine).
///
/// E_CALIB_QUALITY when fewer than three views have eight corners, or no start leads anywhere.
/// Whether the result is good enough is for faults_of.
Expected<CameraSolution> solve_camera(std::span<const BoardView> views, ImageSize size, Lens lens);

}  // namespace swarmsmith
