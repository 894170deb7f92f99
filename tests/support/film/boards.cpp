#include "tests/support/film/boards.h"

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "tests/support/overhead_camera.h"
#include "tracking/calibration/internal/charuco.h"

namespace swarmsmith::film {
namespace {

constexpr int kSquare_px = 40;  ///< of the board's picture; a whole number of marker cells

cv::Mat chessboard(const BoardKind& kind) {
  cv::Mat image(kind.rows * kSquare_px, kind.columns * kSquare_px, CV_8U, cv::Scalar(255));
  for (int row = 0; row < kind.rows; ++row) {
    for (int column = 0; column < kind.columns; ++column) {
      if ((row + column) % 2 == 0)
        image(cv::Rect(column * kSquare_px, row * kSquare_px, kSquare_px, kSquare_px)) = 0;
    }
  }
  return image;
}

cv::Mat charuco(const BoardKind& kind) {
  const auto board =
      swarmsmith::charuco::board(kind.columns, kind.rows, static_cast<float>(kind.square_m),
                                 static_cast<float>(kind.marker_m), kind.dictionary);
  cv::Mat image;
  swarmsmith::charuco::draw(board, {kind.columns * kSquare_px, kind.rows * kSquare_px}, image);
  return image;
}

Point3 moved(const std::array<double, 9>& r, const Point3& t, double x, double y) {
  return {r[0] * x + r[1] * y + t.x, r[3] * x + r[4] * y + t.y, r[6] * x + r[7] * y + t.z};
}

}  // namespace

FilmedBoard board_of(const BoardKind& kind) {
  const cv::Mat pattern = kind.charuco ? charuco(kind) : chessboard(kind);
  cv::Mat image;
  constexpr int kMargin = kSquare_px / 2;
  cv::copyMakeBorder(pattern, image, kMargin, kMargin, kMargin, kMargin, cv::BORDER_CONSTANT,
                     cv::Scalar(255));
  FilmedBoard board;
  board.width = image.cols;
  board.height = image.rows;
  board.pixel_m = kind.square_m / kSquare_px;
  board.margin_px = kMargin;
  board.gray.assign(image.data, image.data + image.total());
  return board;
}

std::vector<Point> inner_corners(const BoardKind& kind) {
  std::vector<Point> corners;
  for (int row = 1; row < kind.rows; ++row) {
    for (int column = 1; column < kind.columns; ++column)
      corners.push_back({column * kind.square_m, row * kind.square_m});
  }
  return corners;
}

FilmedBoard held(const FilmedBoard& board, const BoardKind& kind, const CameraModel& camera,
                 ImagePoint middle, double distance_m, double tilt_x, double tilt_y, double turn) {
  FilmedBoard there = board;
  there.rotation = rotation_about(tilt_x, tilt_y, turn);
  const Ray ray = rays_of(camera, std::vector<ImagePoint>{middle}).front();
  const Point3 centre{ray.x * distance_m, ray.y * distance_m, distance_m};
  const Point3 half = moved(there.rotation, {}, kind.width_m() / 2, kind.height_m() / 2);
  there.translation = {centre.x - half.x, centre.y - half.y, centre.z - half.z};
  return there;
}

ImagePoint image_of_board(const FilmedBoard& board, const CameraModel& camera, Point point) {
  return image_of(camera, moved(board.rotation, board.translation, point.x, point.y));
}

std::vector<FilmedBoard> calibration_views(const BoardKind& kind, const CameraModel& camera,
                                           int count, Rng rng) {
  const FilmedBoard board = board_of(kind);
  const double width = camera.size.width;
  const double height = camera.size.height;
  std::vector<FilmedBoard> views;
  for (int i = 0; i < count; ++i) {
    // The nine thirds in turn, corners nearer to the edge each second time.
    const int third = i % 9;
    const double reach = (kind.charuco ? 0.30 : 0.28) + 0.06 * (i / 9 % 2);
    const ImagePoint middle{width * (0.5 + reach * (third % 3 - 1)),
                            height * (0.5 + reach * (third / 3 - 1))};
    constexpr double kDegree = std::numbers::pi / 180;
    // Every fourth flat, the others tilted towards all sides.
    const double tilt = i % 4 == 0 ? 4 * kDegree : rng.uniform(18, 38) * kDegree;
    const double side = rng.uniform(0, 2 * std::numbers::pi);
    const double turn = rng.uniform(-12, 12) * kDegree;
    // Of the image's width; a chessboard must be seen whole.
    const double share = kind.charuco ? rng.uniform(0.36, 0.62) : rng.uniform(0.24, 0.36);
    const double distance = camera.fx * kind.width_m() / (share * width);
    views.push_back(held(board, kind, camera, middle, distance, tilt * std::cos(side),
                         tilt * std::sin(side), turn));
  }
  return views;
}

}  // namespace swarmsmith::film
