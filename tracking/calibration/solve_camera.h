#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "base/expected.h"
#include "tracking/geometry/camera_model.h"
#include "tracking/rig/rig.h"

namespace swarmsmith {

/// The corners of a board in one picture: their positions on the board (metres, in its plane) and
/// in the image.
struct BoardView {
  std::string name;  ///< name of the picture
  std::vector<Point> board;
  std::vector<ImagePoint> seen;  ///< the same number, in the same order
};

/// How well a view fits the solved camera.
struct SolvedView {
  double rms_px = 0;
  bool dropped = false;               ///< dropped as an outlier; its RMS is from before that
  std::vector<ImagePoint> residuals;  ///< seen minus expected, one per corner
};

/// The distribution of corners over a frame.
struct FrameCoverage {
  std::array<int, 9> ninths{};   ///< number of corners in each ninth, row by row
  double share = 0;              ///< share of the frame within the hull of the corners
  std::vector<ImagePoint> hull;  ///< rounded to a tenth of a pixel
};
FrameCoverage coverage_of(std::span<const ImagePoint> corners, ImageSize size);

struct CameraSolution {
  CameraCalibration calibration;  ///< without board and date
  std::vector<SolvedView> views;  ///< one per given view
  std::array<int, 9> ninths{};    ///< corners of used views in each ninth of the frame, row by row
};

/// Finds the lens model that fits the views best. OpenCV's solvers run until they have converged,
/// with up to 300 iterations to a step of 1e-12 (tracking facts, section 2: the default of 30
/// iterations gives a wrong focal length that still looks plausible). They start with and without a
/// guess, and the result with the lowest RMS is kept. While the RMS of the worst view is above
/// three times the median, this view is dropped and the rest is solved again.
///
/// E_CALIB_QUALITY if fewer than three views have eight corners, or if no start converges.
/// faults_of decides whether the result is good enough.
Expected<CameraSolution> solve_camera(std::span<const BoardView> views, ImageSize size, Lens lens);

}  // namespace swarmsmith
