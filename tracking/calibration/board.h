#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "sim/mission/pose.h"

namespace swarmsmith {

/// A calibration board. A ChArUco board is a chessboard with a marker in each white square; a part
/// of it may be outside the picture. A plain chessboard is only found if it is completely visible.
struct Board {
  enum class Kind { Charuco, Chessboard };
  Kind kind = Kind::Charuco;
  int columns = 0;  ///< ChArUco: squares; chessboard: inner corners
  int rows = 0;
  double square_m = 0;     ///< edge of a square
  double marker_m = 0;     ///< edge of a marker's black border; only ChArUco
  std::string dictionary;  ///< of the markers, "5x5_100"; only ChArUco

  /// Size of the chequered part, without a margin.
  double width_m() const;
  double height_m() const;

  friend bool operator==(const Board&, const Board&) = default;
};

/// Reads a board from a text. "charuco:11x8:0.03:0.022:5x5_100": columns x rows of squares, edges
/// of square and marker in metres, dictionary. "chessboard:10x7:0.03": columns x rows of inner
/// corners, edge of a square. BadInput names the error and shows a correct text.
Expected<Board> parse_board(std::string_view word);
/// The board as a text; parse_board gives the same board again.
std::string board_text(const Board& board);

/// Names of OpenCV's marker dictionaries: "4x4_50" to "7x7_1000", "aruco_original" and
/// "apriltag_16h5" to "apriltag_36h11".
std::vector<std::string> board_dictionaries();

/// The inner corners in metres from the upper left corner of the chequered part, y down, row by row
/// from the top: corner i of OpenCV's ChArUco board is item i.
std::vector<Point> corners_of(const Board& board);

/// A black rectangle of the printed board; metres from the upper left corner, y down.
struct BlackBox {
  double left_m = 0;
  double top_m = 0;
  double width_m = 0;
  double height_m = 0;
};

/// The black parts of the board: its squares and the cells of its markers, as OpenCV 4.6 expects
/// them.
std::vector<BlackBox> black_boxes_of(const Board& board);

}  // namespace swarmsmith
