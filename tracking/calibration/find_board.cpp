#include "tracking/calibration/find_board.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "tracking/calibration/internal/marker_board.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kLeastCorners = 8;

struct Found {
  std::vector<int> ids;  ///< numbers of inner corners
  std::vector<cv::Point2f> corners;
};

/// The smallest distance, in pixels, between neighbouring corners of a row or column.
double least_square_px(int columns, const Found& found) {
  double least = 0;
  for (std::size_t i = 0; i < found.ids.size(); ++i) {
    for (std::size_t k = i + 1; k < found.ids.size(); ++k) {
      const int apart = found.ids[k] - found.ids[i];
      const bool in_row = apart == 1 && found.ids[k] % columns != 0;
      if (!in_row && apart != columns) continue;
      const double square = cv::norm(found.corners[k] - found.corners[i]);
      if (least == 0 || square < least) least = square;
    }
  }
  return least;
}

/// OpenCV's own refinement stops at a tenth of a pixel, and for chessboards it is wrong by up to a
/// pixel if the lens distorts. This refines further, in windows that avoid the print near the
/// corner. `free` is the share of a square without print on each side of a corner.
void refine(const cv::Mat& image, int columns, double free, Found& found) {
  const double free_px = free * least_square_px(columns, found);
  const int half = std::clamp(static_cast<int>(free_px * 0.9), 2, 8);
  const cv::TermCriteria converged(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 0.001);
  const std::vector<cv::Point2f> before = found.corners;
  cv::cornerSubPix(image, found.corners, {half, half}, {-1, -1}, converged);
  // A corner that moved far has found another edge.
  const double most = std::max(1.5, free_px / 2);
  Found kept;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (cv::norm(found.corners[i] - before[i]) > most) continue;
    kept.ids.push_back(found.ids[i]);
    kept.corners.push_back(found.corners[i]);
  }
  found = std::move(kept);
}

Found find_charuco(const cv::Mat& image, const Board& board) {
  const auto printed = marker_board(board);
  std::vector<int> markers;
  std::vector<std::vector<cv::Point2f>> borders;
  cv::aruco::detectMarkers(image, charuco::dictionary_of(printed), borders, markers);
  Found found;
  if (markers.empty()) return found;
  cv::aruco::interpolateCornersCharuco(borders, markers, image, printed, found.corners, found.ids);
  if (found.ids.empty()) return found;
  const double beside_marker = (board.square_m - board.marker_m) / 2 / board.square_m;
  refine(image, board.columns - 1, beside_marker, found);
  return found;
}

/// Searches a picture that is reduced by the factor `shrunk`, which takes a fraction of the time.
/// Corners are refined in the full picture, so the results are equal to 1/1000 of a pixel.
Found find_chessboard(const cv::Mat& image, const Board& board, int shrunk) {
  Found found;
  cv::Mat small = image;
  if (shrunk > 1) cv::resize(image, small, image.size() / shrunk, 0, 0, cv::INTER_AREA);
  if (!cv::findChessboardCornersSB(small, {board.columns, board.rows}, found.corners,
                                   cv::CALIB_CB_NORMALIZE_IMAGE)) {
    return {};
  }
  const double x = static_cast<double>(image.cols) / small.cols;
  const double y = static_cast<double>(image.rows) / small.rows;
  for (std::size_t i = 0; i < found.corners.size(); ++i) {
    // Centres of pixels have integer coordinates.
    cv::Point2f& at = found.corners[i];
    at = cv::Point2f(static_cast<float>((at.x + 0.5) * x - 0.5),
                     static_cast<float>((at.y + 0.5) * y - 0.5));
    found.ids.push_back(static_cast<int>(i));
  }
  refine(image, board.columns, 0.5, found);
  return found;
}

/// Searches the full picture only if the reduced one does not show the complete board.
Found find_chessboard(const cv::Mat& image, const Board& board) {
  constexpr int kWide = 1200;
  const auto all = static_cast<std::size_t>(board.columns * board.rows);
  if (std::max(image.cols, image.rows) > kWide) {
    Found found = find_chessboard(image, board, 2);
    if (found.ids.size() == all) return found;
  }
  return find_chessboard(image, board, 1);
}

/// If all corners are on one line, the board's tilt is unknown.
bool is_flat_line(const std::vector<Point>& board) {
  const auto differs = [](auto coordinate) {
    return [coordinate](const Point& a, const Point& b) {
      return std::abs(coordinate(a) - coordinate(b)) > 1e-9;
    };
  };
  const auto x = differs([](const Point& p) { return p.x; });
  const auto y = differs([](const Point& p) { return p.y; });
  const auto& first = board.front();
  return std::ranges::none_of(board, [&](const Point& p) { return x(p, first); }) ||
         std::ranges::none_of(board, [&](const Point& p) { return y(p, first); });
}

/// Mean absolute second derivative in the board's bounding box, relative to its contrast.
double sharpness_of(const cv::Mat& image, const std::vector<cv::Point2f>& corners) {
  const cv::Rect box = cv::boundingRect(corners) & cv::Rect(0, 0, image.cols, image.rows);
  if (box.empty()) return 0;
  cv::Mat second;
  cv::Laplacian(image(box), second, CV_32F);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(image(box), mean, deviation);
  return cv::norm(second, cv::NORM_L2) / std::sqrt(static_cast<double>(box.area())) /
         std::max(deviation[0], 1.0);
}

/// The positions of the board's four outer corners, extrapolated if necessary, as shares of the
/// picture's width.
using Outline = std::array<cv::Point2d, 4>;

Outline outline_of(const BoardView& view, const Board& board, ImageSize size) {
  std::vector<cv::Point2d> from;
  std::vector<cv::Point2d> to;
  for (std::size_t i = 0; i < view.seen.size(); ++i) {
    from.emplace_back(view.board[i].x, view.board[i].y);
    to.emplace_back(view.seen[i].u / size.width, view.seen[i].v / size.width);
  }
  const cv::Mat plane = cv::findHomography(from, to);
  Outline outline;
  if (plane.empty()) return outline;
  const double w = board.width_m();
  const double h = board.height_m();
  const std::vector<cv::Point2d> ends{{0, 0}, {w, 0}, {w, h}, {0, h}};
  std::vector<cv::Point2d> seen;
  cv::perspectiveTransform(ends, seen, plane);
  std::copy(seen.begin(), seen.end(), outline.begin());
  return outline;
}

double distance(const Outline& a, const Outline& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    most = std::max(most, cv::norm(a[i] - b[i]));
  return most;
}

}  // namespace

std::optional<BoardSight> find_board(const GrayImage& image, const Board& board) {
  // OpenCV has no matrix type for constant pixels; it only reads them here.
  const cv::Mat gray(image.height, image.width, CV_8U, const_cast<std::uint8_t*>(image.pixels),
                     static_cast<std::size_t>(image.stride));
  const Found found =
      board.kind == Board::Kind::Charuco ? find_charuco(gray, board) : find_chessboard(gray, board);
  if (found.ids.size() < kLeastCorners) return std::nullopt;
  const std::vector<Point> corners = corners_of(board);
  BoardSight sight;
  for (std::size_t i = 0; i < found.ids.size(); ++i) {
    sight.view.board.push_back(corners.at(static_cast<std::size_t>(found.ids[i])));
    sight.view.seen.push_back(
        {static_cast<double>(found.corners[i].x), static_cast<double>(found.corners[i].y)});
  }
  if (is_flat_line(sight.view.board)) return std::nullopt;
  sight.sharpness = sharpness_of(gray, found.corners);
  return sight;
}

std::vector<std::size_t> pick_views(const std::vector<BoardSight>& sights, const Board& board,
                                    ImageSize size, std::size_t most) {
  constexpr double kAlike = 0.05;
  std::vector<Outline> outlines;
  outlines.reserve(sights.size());
  for (const BoardSight& sight : sights)
    outlines.push_back(outline_of(sight.view, board, size));
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < sights.size(); ++i) {
    const auto alike = std::ranges::min_element(
        kept, {}, [&](std::size_t k) { return distance(outlines[i], outlines[k]); });
    if (alike == kept.end() || distance(outlines[i], outlines[*alike]) > kAlike) {
      kept.push_back(i);
    } else if (sights[i].sharpness > sights[*alike].sharpness) {
      *alike = i;
    }
  }
  // If there are too many, take those that differ most from all that were taken before.
  std::vector<std::size_t> picked;
  while (!kept.empty() && picked.size() < most) {
    const auto loneliness = [&](std::size_t i) {
      double least = 1e9;
      for (const std::size_t k : picked)
        least = std::min(least, distance(outlines[i], outlines[k]));
      return least;
    };
    const auto next = std::ranges::max_element(kept, {}, loneliness);
    picked.push_back(*next);
    kept.erase(next);
  }
  std::ranges::sort(picked);
  return picked;
}

}  // namespace swarmsmith
