#include "tracking/calibration/board.h"

#include <cmath>

#include "tests/support/checks.h"
#include "tracking/calibration/internal/charuco.h"

namespace swarmsmith {
namespace {

TEST(BoardTest, WordsReadBack) {
  for (const char* word : {"charuco:11x8:0.03:0.022:5x5_100", "chessboard:10x7:0.03",
                           "charuco:5x7:0.04:0.03:apriltag_36h11"}) {
    const auto board = value_of(parse_board(word));
    EXPECT_EQ(board_text(board), word);
  }
}

TEST(BoardTest, WrongWordsAreExplained) {
  const auto message = [](const char* word) {
    const auto board = parse_board(word);
    return board ? std::string("accepted") : to_string(board.error());
  };
  EXPECT_THAT(message("chess"), HasSubstr("neither charuco nor chessboard"));
  EXPECT_THAT(message("chessboard:10x7"), HasSubstr("1 parts"));
  EXPECT_THAT(message("chessboard:10:0.03"), HasSubstr("COLUMNSxROWS"));
  EXPECT_THAT(message("chessboard:10x7:x"), HasSubstr("not a number"));
  EXPECT_THAT(message("chessboard:2x7:0.03"), HasSubstr("3 to 100 inner corners"));
  EXPECT_THAT(message("chessboard:10x7:nan"), HasSubstr("0.001 to 1"));
  EXPECT_THAT(message("charuco:11x8:0.03:0.04:5x5_100"), HasSubstr("smaller than its square"));
  EXPECT_THAT(message("charuco:11x8:0.03:0.02:5x5_10"), HasSubstr("did you mean"));
  EXPECT_THAT(message("charuco:20x20:0.03:0.02:5x5_100"), HasSubstr("needs 200 markers"));
}

TEST(BoardTest, CountsInnerCorners) {
  EXPECT_EQ(corners_of(*parse_board("charuco:11x8:0.03:0.022:5x5_100")).size(), 70U);
  EXPECT_EQ(corners_of(*parse_board("chessboard:10x7:0.03")).size(), 70U);
}

/// Cells of whole millimetres, so that OpenCV's own picture at a pixel a millimetre is exact.
TEST(BoardTest, IsBlackWhereOpencvDrawsBlack) {
  for (const int rows : {3, 4}) {
    const auto board = parse_board("charuco:5x" + std::to_string(rows) + ":0.035:0.021:5x5_100");
    const auto theirs = charuco::board(5, rows, 35, 21, cv::aruco::DICT_5X5_100);
    cv::Mat expected;
    charuco::draw(theirs, {175, 35 * rows}, expected);
    cv::Mat drawn(35 * rows, 175, CV_8U, cv::Scalar(255));
    for (const BlackBox& box : black_boxes_of(*board)) {
      const auto pixel = [](double metres) { return static_cast<int>(std::lround(1000 * metres)); };
      drawn(cv::Rect(pixel(box.left_m), pixel(box.top_m), pixel(box.width_m),
                     pixel(box.height_m))) = 0;
    }
    EXPECT_EQ(cv::countNonZero(drawn != expected), 0) << rows << " rows";
  }
}

}  // namespace
}  // namespace swarmsmith
