#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/film/boards.h"
#include "tests/tracking/film/small_scene.h"
#include "tracking/calibration/internal/charuco.h"

namespace swarmsmith::film {
namespace {

struct Sum {
  double u = 0;
  double v = 0;
  double squares = 0;
  int count = 0;

  void add(const cv::Point2f& found, const ImagePoint& truth) {
    const double du = static_cast<double>(found.x) - truth.u;
    const double dv = static_cast<double>(found.y) - truth.v;
    u += du;
    v += dv;
    squares += du * du + dv * dv;
    ++count;
  }
  void expect_true(int least) const {
    ASSERT_GE(count, least);
    EXPECT_NEAR(u / count, 0, 0.05);
    EXPECT_NEAR(v / count, 0, 0.05);
    EXPECT_LT(std::sqrt(squares / count), 0.25);
  }
};

std::vector<std::uint8_t> picture_of(const FilmedBoard& board, const Shooting& shooting,
                                     const std::shared_ptr<const LensMap>& lens) {
  Scene scene;
  scene.boards.push_back(board);
  return gray_of(VirtualCamera(scene, shooting, lens, 1).picture(0, 0));
}

class BoardTest : public testing::Test {
 protected:
  Shooting shooting_ = shooting_of(960);
  CameraModel camera_ = shooting_.view.camera;
  std::shared_ptr<const LensMap> lens_ =
      std::make_shared<const LensMap>(lens_map_of(shooting_.view.camera));

  cv::Mat as_mat(std::vector<std::uint8_t>& gray) const {
    return cv::Mat(camera_.size.height, camera_.size.width, CV_8U, gray.data());
  }
};

TEST_F(BoardTest, CharucoCornersAreWhereOpenCvFindsThem) {
  const BoardKind kind;
  const auto board = charuco::board(kind.columns, kind.rows, static_cast<float>(kind.square_m),
                                    static_cast<float>(kind.marker_m), kind.dictionary);
  const std::vector<cv::Point3f> inner_corners = charuco::inner_corners_of(board);
  Sum sum;
  int views = 0;
  int taken = 0;
  for (const FilmedBoard& view : calibration_views(kind, camera_, 22, Rng(5))) {
    if (++taken % 2 == 0) continue;  // half of them prove as much
    std::vector<std::uint8_t> gray = picture_of(view, shooting_, lens_);
    std::vector<std::vector<cv::Point2f>> markers;
    std::vector<int> ids;
    cv::aruco::detectMarkers(as_mat(gray), charuco::dictionary_of(board), markers, ids);
    if (ids.size() < 4) continue;
    std::vector<cv::Point2f> corners;
    std::vector<int> numbers;
    cv::aruco::interpolateCornersCharuco(markers, ids, as_mat(gray), board, corners, numbers);
    // OpenCV 4.6 gives these corners half a pixel too far right and down, and stops early.
    cv::cornerSubPix(as_mat(gray), corners, {2, 2}, {-1, -1},
                     {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 50, 1e-4});
    ++views;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const cv::Point3f place = inner_corners[static_cast<std::size_t>(numbers[i])];
      sum.add(corners[i],
              image_of_board(view, camera_,
                             {static_cast<double>(place.x), static_cast<double>(place.y)}));
    }
  }
  EXPECT_GE(views, 9);
  sum.expect_true(200);
}

TEST_F(BoardTest, ChessboardCornersAreWhereOpenCvFindsThem) {
  BoardKind kind;
  kind.charuco = false;
  const FilmedBoard board = board_of(kind);
  Sum sum;
  for (const double turn : {0.1, -0.3}) {
    const FilmedBoard view = held(board, kind, camera_, {500, 280}, 0.45, 0.4, -0.3, turn);
    std::vector<std::uint8_t> gray = picture_of(view, shooting_, lens_);
    std::vector<cv::Point2f> corners;
    const cv::Size size(kind.columns - 1, kind.rows - 1);
    ASSERT_TRUE(cv::findChessboardCorners(as_mat(gray), size, corners));
    cv::cornerSubPix(as_mat(gray), corners, {4, 4}, {-1, -1},
                     {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 50, 1e-4});
    // From which end the board is read is not told apart.
    for (const cv::Point2f& found : corners) {
      ImagePoint nearest{1e9, 1e9};
      for (const Point& point : inner_corners(kind)) {
        const ImagePoint truth = image_of_board(view, camera_, point);
        if (std::hypot(truth.u - static_cast<double>(found.x),
                       truth.v - static_cast<double>(found.y)) <
            std::hypot(nearest.u - static_cast<double>(found.x),
                       nearest.v - static_cast<double>(found.y)))
          nearest = truth;
      }
      sum.add(found, nearest);
    }
  }
  sum.expect_true(80);
}

}  // namespace
}  // namespace swarmsmith::film
