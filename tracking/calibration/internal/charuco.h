#pragma once

#include <opencv2/aruco/charuco.hpp>
#include <opencv2/core/version.hpp>
#include <vector>

/// OpenCV's ChArUco boards. Version 4.7 replaced their members by getters, and made a dictionary a
/// value.
namespace swarmsmith::charuco {

using Board = cv::Ptr<cv::aruco::CharucoBoard>;

#if CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR < 7

inline Board board(int columns, int rows, float square, float marker, int dictionary) {
  return cv::aruco::CharucoBoard::create(columns, rows, square, marker,
                                         cv::aruco::getPredefinedDictionary(dictionary));
}
inline cv::Ptr<cv::aruco::Dictionary> dictionary_of(int number) {
  return cv::aruco::getPredefinedDictionary(number);
}
inline cv::Ptr<cv::aruco::Dictionary> dictionary_of(const Board& board) {
  return board->dictionary;
}
inline const std::vector<int>& ids_of(const Board& board) {
  return board->ids;
}
/// The four corners of each marker, the upper left one first, in the units of the board.
inline const std::vector<std::vector<cv::Point3f>>& markers_of(const Board& board) {
  return board->objPoints;
}
inline std::vector<cv::Point3f> inner_corners_of(const Board& board) {
  return board->chessboardCorners;
}
inline void draw(const Board& board, cv::Size size, cv::Mat& image) {
  board->draw(size, image, 0, 1);
}
/// `side` is in pixels.
inline void draw_marker(const Board& board, int id, int side, cv::Mat& image) {
  cv::aruco::drawMarker(board->dictionary, id, side, image);
}

#else

inline Board board(int columns, int rows, float square, float marker, int dictionary) {
  return cv::makePtr<cv::aruco::CharucoBoard>(cv::Size(columns, rows), square, marker,
                                              cv::aruco::getPredefinedDictionary(dictionary));
}
inline cv::Ptr<cv::aruco::Dictionary> dictionary_of(int number) {
  return cv::makePtr<cv::aruco::Dictionary>(cv::aruco::getPredefinedDictionary(number));
}
inline cv::Ptr<cv::aruco::Dictionary> dictionary_of(const Board& board) {
  return cv::makePtr<cv::aruco::Dictionary>(board->getDictionary());
}
inline const std::vector<int>& ids_of(const Board& board) {
  return board->getIds();
}
/// The four corners of each marker, the upper left one first, in the units of the board.
inline const std::vector<std::vector<cv::Point3f>>& markers_of(const Board& board) {
  return board->getObjPoints();
}
inline std::vector<cv::Point3f> inner_corners_of(const Board& board) {
  return board->getChessboardCorners();
}
inline void draw(const Board& board, cv::Size size, cv::Mat& image) {
  board->generateImage(size, image, 0, 1);
}
/// `side` is in pixels.
inline void draw_marker(const Board& board, int id, int side, cv::Mat& image) {
  cv::aruco::generateImageMarker(board->getDictionary(), id, side, image);
}

#endif

}  // namespace swarmsmith::charuco
