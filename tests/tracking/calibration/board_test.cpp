#include "tracking/calibration/board.h"

#include <gmock/gmock.h>

namespace swarmsmith {
namespace {

using testing::HasSubstr;

TEST(BoardTest, WordsReadBack) {
  for (const char* word : {"charuco:11x8:0.03:0.022:5x5_100", "chessboard:10x7:0.03",
                           "charuco:5x7:0.04:0.03:apriltag_36h11"}) {
    const auto board = parse_board(word);
    ASSERT_TRUE(board) << to_string(board.error());
    EXPECT_EQ(board_text(*board), word);
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
  EXPECT_THAT(message("chessboard:10x7:x"), HasSubstr("no number"));
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

}  // namespace
}  // namespace swarmsmith
