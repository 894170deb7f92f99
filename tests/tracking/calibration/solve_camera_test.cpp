#include "tracking/calibration/solve_camera.h"

#include <limits>
#include <numbers>

#include <opencv2/calib3d.hpp>

#include "synthetic.h"
#include "tests/support/checks.h"
#include "tracking/calibration/calibration_report.h"
#include "tracking/rig/calibration_limits.h"

namespace swarmsmith {
namespace {

/// What a script finds that calls OpenCV as its tutorial does.
CameraModel solved_by_defaults(const std::vector<BoardView>& views, ImageSize size) {
  std::vector<std::vector<cv::Point3f>> board;
  std::vector<std::vector<cv::Point2f>> seen;
  for (const BoardView& view : views) {
    board.emplace_back();
    seen.emplace_back();
    for (std::size_t i = 0; i < view.seen.size(); ++i) {
      board.back().emplace_back(static_cast<float>(view.board[i].x),
                                static_cast<float>(view.board[i].y), 0.0F);
      seen.back().emplace_back(static_cast<float>(view.seen[i].u),
                               static_cast<float>(view.seen[i].v));
    }
  }
  cv::Mat matrix;
  cv::Mat distortion;
  std::vector<cv::Mat> turns;
  std::vector<cv::Mat> shifts;
  cv::calibrateCamera(board, seen, {size.width, size.height}, matrix, distortion, turns, shifts);
  return {size, Lens::Pinhole, matrix.at<double>(0, 0), matrix.at<double>(1, 1), 0, 0, {}};
}

CameraSolution solved(const std::vector<BoardView>& views, const CameraModel& camera) {
  return value_of(solve_camera(views, camera.size, camera.lens));
}

std::string faults(const CameraCalibration& calibration) {
  std::string text;
  for (const Error& error : faults_of(calibration))
    text += to_string(error) + "\n";
  return text;
}

TEST(SolveCameraTest, FindsTheCameraThatSawTheBoards) {
  const CameraModel camera = wide_camera();
  const CameraSolution exact = solved(held_boards(camera, 17, 1, {.noise_px = 0}), camera);
  EXPECT_LT(exact.calibration.rms_px, 0.001);
  EXPECT_NEAR(exact.calibration.model.fx, camera.fx, 0.1);
  EXPECT_NEAR(exact.calibration.model.cx, camera.cx, 0.1);
  EXPECT_NEAR(exact.calibration.model.cy, camera.cy, 0.1);
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const CameraCalibration noisy = solved(held_boards(camera, 17, seed), camera).calibration;
    EXPECT_EQ(faults(noisy), "");
    EXPECT_NEAR(noisy.rms_px, 0.05 * std::numbers::sqrt2, 0.005);
    // What the fit says of itself is true.
    EXPECT_LT(noisy.focal_sigma_px, 0.5);
    EXPECT_NEAR(noisy.model.fx, camera.fx, 4 * noisy.focal_sigma_px);
    EXPECT_NEAR(noisy.model.fy, camera.fy, 4 * noisy.focal_sigma_px);
  }
}

/// The trap of tracking facts, section 2: the solver's own criteria stop it on the way.
TEST(SolveCameraTest, ConvergesWhereTheSolversDefaultsGiveAWrongFocalLength) {
  const CameraModel camera = wide_camera();
  const Holding carefully{.most_tilt_rad = 30 * kPi / 180};
  const Holding from_afar{.most_tilt_rad = 40 * kPi / 180, .farthest_m = 2};
  for (const Holding& holding : {carefully, from_afar}) {
    const std::vector<BoardView> views = held_boards(camera, 17, 1, holding);
    EXPECT_GT(std::abs(solved_by_defaults(views, camera.size).fx / camera.fx - 1), 0.1);
    const CameraCalibration ours = solved(views, camera).calibration;
    EXPECT_NEAR(ours.model.fx, camera.fx, 4 * ours.focal_sigma_px);
    EXPECT_LT(ours.focal_sigma_px, 0.002 * camera.fx);
    EXPECT_NEAR(ours.rms_px, 0.07, 0.01);
    EXPECT_EQ(ours.views_dropped, 0);
  }
}

TEST(SolveCameraTest, AViewThatDoesNotFitIsDropped) {
  const CameraModel camera = wide_camera();
  std::vector<BoardView> views = held_boards(camera, 17, 1);
  // The board was bent, and moved: corners off by a pixel, and one by 30.
  for (std::size_t i = 0; i < views[4].seen.size(); ++i)
    views[4].seen[i].u += std::sin(static_cast<double>(i));
  views[9].seen[3].v += 30;
  const CameraSolution solution = solved(views, camera);
  EXPECT_EQ(solution.calibration.views_dropped, 2);
  EXPECT_EQ(solution.calibration.views, 15);
  EXPECT_TRUE(solution.views[4].dropped);
  EXPECT_TRUE(solution.views[9].dropped);
  EXPECT_NEAR(solution.calibration.model.fx, camera.fx, 1);
}

TEST(SolveCameraTest, AFisheyeIsSolvedToo) {
  const CameraModel camera{
      {1920, 1080}, Lens::Fisheye, 620, 622, 955, 542, {0.02, -0.004, 0.0005, 0, 0}};
  const CameraCalibration found = solved(held_boards(camera, 20, 2), camera).calibration;
  EXPECT_NEAR(found.model.fx, camera.fx, 0.6);
  EXPECT_NEAR(found.model.fy, camera.fy, 0.6);
  EXPECT_NEAR(found.model.cx, camera.cx, 0.6);
  EXPECT_NEAR(found.rms_px, 0.07, 0.01);
  EXPECT_EQ(found.model.lens, Lens::Fisheye);
}

/// The same lens and pictures, twice as large: the limit is an angle, and no number of pixels.
TEST(SolveCameraTest, TheLimitGrowsWithThePicture) {
  CameraCalibration large;
  large.model = wide_camera();
  large.views = 20;
  large.coverage = 0.9;
  large.rms_px = 0.45;
  EXPECT_EQ(faults(large), "");
  CameraCalibration small = large;
  small.model.size = {960, 540};
  for (double* value : {&small.model.fx, &small.model.fy, &small.model.cx, &small.model.cy})
    *value /= 2;
  EXPECT_THAT(faults(small), HasSubstr("0.450 px, limit 0.25 px (2.22 mm on a floor 2.5 m below"));
  small.rms_px /= 2;
  EXPECT_EQ(faults(small), "");
}

TEST(SolveCameraTest, EachLimitRefusesWithItsValue) {
  const CameraModel camera = wide_camera();
  EXPECT_THAT(faults(solved(held_boards(camera, 9, 1), camera).calibration),
              AllOf(HasSubstr("E_CALIB_QUALITY"), HasSubstr("9 usable views, at least 10")));
  EXPECT_THAT(faults(solved(held_boards(camera, 17, 1, {.noise_px = 0.5}), camera).calibration),
              AllOf(HasSubstr("RMS reprojection 0.7"), HasSubstr("limit 0.51 px"),
                    HasSubstr("on a floor 2.5 m below; limit 1.25 mm")));
  // The board never came into the right half.
  std::vector<BoardView> left;
  for (const BoardView& view : held_boards(camera, 60, 1)) {
    const auto is_left = [](const ImagePoint& at) { return at.u < 1100; };
    if (std::ranges::all_of(view.seen, is_left)) left.push_back(view);
  }
  const CameraSolution half = solved(left, camera);
  EXPECT_THAT(faults(half.calibration), Not(HasSubstr("of the frame")));
  EXPECT_THAT(cautions_of(half.calibration), Contains(HasSubstr("the arena must lie within it")));
  // A file that does not say where its corners were needs all of the frame.
  CameraCalibration old = half.calibration;
  old.hull.clear();
  EXPECT_THAT(faults(old), HasSubstr("% of the frame, at least 70 %"));
  EXPECT_EQ(half.ninths[2] + half.ninths[5] + half.ninths[8], 0);
  EXPECT_GT(half.ninths[0], 0);

  const std::vector<BoardView> good = held_boards(camera, 17, 1);
  EXPECT_THAT(report_text(solved(good, camera), good),
              HasSubstr("mm on a floor 2.5 m below; limit 0.51 px, 1.25 mm on a floor"));
  CameraCalibration odd = solved(good, camera).calibration;
  EXPECT_THAT(cautions_of(odd), IsEmpty());
  odd.model.fy *= 1.03;
  EXPECT_THAT(faults(odd), HasSubstr("differ by 2.9 %, limit 2 %"));
  odd.model.fy = odd.model.fx;
  odd.model.cx += 300;
  EXPECT_THAT(faults(odd), HasSubstr("16 % off the middle, limit 10 %"));
  odd.model.cx -= 300;
  odd.model.distortion = {-0.6, 0, 0, 0, 0};
  EXPECT_THAT(faults(odd), HasSubstr("folds within the frame"));
  odd.rms_px = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(faults(odd), HasSubstr("RMS reprojection nan"));
}

TEST(SolveCameraTest, ViewsWithoutCornersAreNoViews) {
  const CameraModel camera = wide_camera();
  std::vector<BoardView> views = held_boards(camera, 2, 1);
  views.emplace_back();
  EXPECT_THAT(complaint_of(solve_camera(views, camera.size, Lens::Pinhole)),
              AllOf(HasSubstr("E_CALIB_QUALITY"), HasSubstr("2 views show at least 8 corners")));
}

}  // namespace
}  // namespace swarmsmith
