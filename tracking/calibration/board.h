#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "sim/mission/pose.h"

namespace swarmsmith {

/// A calibration board. ChArUco: a chessboard with a marker in each white square, which may stick
/// out of the picture. Chessboard: is only found whole.
struct Board {
  enum class Kind { Charuco, Chessboard };
  Kind kind = Kind::Charuco;
  int columns = 0;  ///< ChArUco: squares; chessboard: inner corners
  int rows = 0;
  double square_m = 0;     ///< edge of a square
  double marker_m = 0;     ///< edge of a marker's black border; ChArUco alone
  std::string dictionary;  ///< of the markers, "5x5_100"; ChArUco alone

  /// All of the chequered part, without a margin.
  double width_m() const;
  double height_m() const;

  friend bool operator==(const Board&, const Board&) = default;
};

/// "charuco:11x8:0.03:0.022:5x5_100": columns x rows of squares, edges of square and marker in
/// metres, dictionary. "chessboard:10x7:0.03": columns x rows of inner corners, edge of a square.
/// BadInput says what is wrong with the word and shows a right one.
Expected<Board> parse_board(std::string_view word);
/// Reads back to the same board.
std::string board_text(const Board& board);

/// Names of OpenCV's marker dictionaries: "4x4_50" to "7x7_1000", "aruco_original" and
/// "apriltag_16h5" to "apriltag_36h11".
std::vector<std::string> board_dictionaries();

/// The inner corners, metres from the chequered part's upper left corner, y down, row by row from
/// above: corner i of OpenCV's ChArUco board is item i.
std::vector<Point> corners_of(const Board& board);

/// A black rectangle of the printed board; metres from the upper left corner, y down.
struct BlackBox {
  double left_m = 0;
  double top_m = 0;
  double width_m = 0;
  double height_m = 0;
};

/// What is black on the board: squares and the cells of its markers, as OpenCV 4.6 expects them.
std::vector<BlackBox> black_boxes_of(const Board& board);

}  // namespace swarmsmith
