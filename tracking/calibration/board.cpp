#include "tracking/calibration/board.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <system_error>

#include "base/plain_text.h"
#include "base/suggestion.h"
#include "base/text/toml_text.h"
#include "tracking/calibration/internal/marker_board.h"

namespace swarmsmith {
namespace {

/// In the order of OpenCV's numbers (PREDEFINED_DICTIONARY_NAME).
constexpr std::array<std::string_view, 21> kDictionaries = {
    "4x4_50",        "4x4_100",        "4x4_250",       "4x4_1000",      "5x5_50",
    "5x5_100",       "5x5_250",        "5x5_1000",      "6x6_50",        "6x6_100",
    "6x6_250",       "6x6_1000",       "7x7_50",        "7x7_100",       "7x7_250",
    "7x7_1000",      "aruco_original", "apriltag_16h5", "apriltag_25h9", "apriltag_36h10",
    "apriltag_36h11"};
static_assert(cv::aruco::DICT_APRILTAG_36h11 + 1 == kDictionaries.size());

constexpr int kMostSquares = 100;

template <class Number>
std::optional<Number> number_in(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

Unexpected wrong(std::string_view word, const std::string& why) {
  return bad_input("E_CONFIG: the board `" + std::string(word) + "` " + why +
                       "; a board is written charuco:COLUMNSxROWS:SQUARE:MARKER:DICTIONARY, such "
                       "as charuco:11x8:0.03:0.022:5x5_100 (squares, edges in metres), or "
                       "chessboard:COLUMNSxROWS:SQUARE, such as chessboard:10x7:0.03 (inner "
                       "corners)",
                   "--board");
}

/// The error in the numbers of a board, if there is one.
std::optional<std::string> flaw_of(const Board& board) {
  const bool charuco = board.kind == Board::Kind::Charuco;
  // OpenCV finds chessboards with at least three inner corners per side.
  if (std::min(board.columns, board.rows) < 3 ||
      std::max(board.columns, board.rows) > kMostSquares) {
    return std::string("needs 3 to 100 ") + (charuco ? "squares" : "inner corners") + " a side";
  }
  if (!(board.square_m >= 0.001 && board.square_m <= 1)) {
    return "needs a square of 0.001 to 1 metres";
  }
  if (!charuco) return std::nullopt;
  if (!(board.marker_m > 0 && board.marker_m < board.square_m)) {
    return "needs a marker that is smaller than its square";
  }
  const auto number = dictionary_number(board.dictionary);
  const std::vector<std::string> known = board_dictionaries();
  if (!number) {
    return "has an unknown dictionary" + did_you_mean(board.dictionary, known) +
           "; known are: " + joined(known);
  }
  const int markers = board.columns * board.rows / 2;
  const int available = charuco::dictionary_of(*number)->bytesList.rows;
  if (markers > available) {
    return "needs " + std::to_string(markers) + " markers, and its dictionary has " +
           std::to_string(available);
  }
  return std::nullopt;
}

}  // namespace

double Board::width_m() const {
  return square_m * (kind == Kind::Charuco ? columns : columns + 1);
}

double Board::height_m() const {
  return square_m * (kind == Kind::Charuco ? rows : rows + 1);
}

std::optional<int> dictionary_number(std::string_view name) {
  const auto* const found = std::find(kDictionaries.begin(), kDictionaries.end(), name);
  if (found == kDictionaries.end()) return std::nullopt;
  return static_cast<int>(found - kDictionaries.begin());
}

charuco::Board marker_board(const Board& board) {
  return charuco::board(board.columns, board.rows, static_cast<float>(board.square_m),
                        static_cast<float>(board.marker_m),
                        dictionary_number(board.dictionary).value());
}

std::vector<std::string> board_dictionaries() {
  return {kDictionaries.begin(), kDictionaries.end()};
}

Expected<Board> parse_board(std::string_view word) {
  const std::vector<std::string_view> parts = split(word, ':');
  Board board;
  if (parts[0] == "chessboard") {
    board.kind = Board::Kind::Chessboard;
  } else if (parts[0] != "charuco") {
    return wrong(word, "is neither charuco nor chessboard");
  }
  const bool charuco = board.kind == Board::Kind::Charuco;
  if (parts.size() != (charuco ? 5 : 3)) {
    return wrong(word, "has " + std::to_string(parts.size() - 1) + " parts after its kind");
  }
  const std::vector<std::string_view> sides = split(parts[1], 'x');
  const auto columns = number_in<int>(sides[0]);
  const auto rows = sides.size() == 2 ? number_in<int>(sides[1]) : std::nullopt;
  const auto square = number_in<double>(parts[2]);
  const auto marker = charuco ? number_in<double>(parts[3]) : 0;
  if (!columns || !rows) return wrong(word, "has no COLUMNSxROWS in its second part");
  if (!square || !marker) return wrong(word, "has an edge that is not a number");
  board.columns = *columns;
  board.rows = *rows;
  board.square_m = *square;
  board.marker_m = *marker;
  if (charuco) board.dictionary = parts[4];
  if (const auto flaw = flaw_of(board)) return wrong(word, *flaw);
  return board;
}

std::string board_text(const Board& board) {
  const std::string sides = std::to_string(board.columns) + "x" + std::to_string(board.rows) + ":" +
                            number_text(board.square_m);
  if (board.kind == Board::Kind::Chessboard) return "chessboard:" + sides;
  return "charuco:" + sides + ":" + number_text(board.marker_m) + ":" + board.dictionary;
}

std::vector<Point> corners_of(const Board& board) {
  const int less = board.kind == Board::Kind::Charuco ? 1 : 0;
  std::vector<Point> corners;
  for (int row = 1; row <= board.rows - less; ++row) {
    for (int column = 1; column <= board.columns - less; ++column)
      corners.push_back({column * board.square_m, row * board.square_m});
  }
  return corners;
}

std::vector<BlackBox> black_boxes_of(const Board& board) {
  const bool charuco = board.kind == Board::Kind::Charuco;
  const int columns = charuco ? board.columns : board.columns + 1;
  const int rows = charuco ? board.rows : board.rows + 1;
  std::vector<BlackBox> boxes;
  // OpenCV 4.6 counts rows from the top, and the first square is black.
  for (int row = 0; row < rows; ++row) {
    for (int column = row % 2; column < columns; column += 2) {
      boxes.push_back(
          {column * board.square_m, row * board.square_m, board.square_m, board.square_m});
    }
  }
  if (!charuco) return boxes;
  const auto printed = marker_board(board);
  const int cells = charuco::dictionary_of(printed)->markerSize + 2;
  const double cell = board.marker_m / cells;
  const std::vector<int>& ids = charuco::ids_of(printed);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    cv::Mat picture;
    charuco::draw_marker(printed, ids[i], cells, picture);
    // The marker's first corner is its upper left one; y points down.
    const cv::Point3f corner = charuco::markers_of(printed)[i].front();
    const auto left = static_cast<double>(corner.x);
    const auto top = static_cast<double>(corner.y);
    for (int row = 0; row < cells; ++row) {
      for (int column = 0; column < cells; ++column) {
        if (picture.at<std::uint8_t>(row, column) != 0) continue;
        boxes.push_back({left + column * cell, top + row * cell, cell, cell});
      }
    }
  }
  return boxes;
}

}  // namespace swarmsmith
