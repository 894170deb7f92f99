#include "tracking/printing/board_sheet.h"

#include "console/pdf.h"
#include "tests/support/checks.h"
#include "tests/support/drawn_page.h"
#include "tests/support/printed_page.h"
#include "tracking/calibration/internal/charuco.h"

namespace swarmsmith {
namespace {

TEST(BoardSheetTest, NamesTheLargestThatFits) {
  const auto sheet =
      board_sheet(*parse_board("charuco:11x8:0.03:0.022:5x5_100"), *paper_from_name("A4"));
  ASSERT_FALSE(sheet);
  const std::string message = to_string(sheet.error());
  EXPECT_THAT(message, HasSubstr("330 x 240 mm, too large for A4"));
  const std::string fitting = message.substr(message.rfind(' ') + 1);
  EXPECT_TRUE(board_sheet(*parse_board(fitting), *paper_from_name("A4"))) << fitting;
}

TEST(BoardSheetTest, AChessboardHasItsSquaresToAHundredthOfAMillimetre) {
  const auto sheet =
      value_of(board_sheet(*parse_board("chessboard:4x3:0.0333"), *paper_from_name("A4")));
  const DrawnPage page = drawn_page(sheet);
  ASSERT_EQ(page.bars.size(), 10U);
  const DrawnPage::Bar& first = page.bars.front();
  for (const DrawnPage::Bar& bar : page.bars) {
    EXPECT_NEAR(bar.length, 33.3, 0.0101);
    EXPECT_NEAR(bar.thickness, 33.3, 0.0101);
    const double columns = (bar.x - first.x) / 33.3;
    const double rows = (bar.y - first.y) / 33.3;
    EXPECT_NEAR(columns * 33.3, std::round(columns) * 33.3, 0.0101);
    EXPECT_NEAR(rows * 33.3, std::round(rows) * 33.3, 0.0101);
  }
  EXPECT_THAT(page.collisions(), IsEmpty());
}

TEST(BoardSheetTest, OpencvReadsThePrintInTrueScale) {
  constexpr int kDpi = 200;
  constexpr double kPixel = 25.4 / kDpi;
  for (const char* word : {"charuco:11x8:0.023:0.017:5x5_100", "charuco:6x5:0.03:0.022:4x4_50"}) {
    const Board board = *parse_board(word);
    const auto sheet = value_of(board_sheet(board, *paper_from_name("A4")));
    const auto pdf = pdf_of_svg(sheet);
    if (!pdf) GTEST_SKIP() << "skipped: " << to_string(pdf.error());
    const auto sizes = page_sizes(*pdf);
    if (!sizes) GTEST_SKIP() << "skipped: " << to_string(sizes.error());
    EXPECT_NEAR(sizes->at(0).width_mm, 297, 0.01);
    auto pages = printed_pages(*pdf, kDpi);
    if (!pages) GTEST_SKIP() << "skipped: " << to_string(pages.error());
    PrintedPage& page = pages->front();
    const cv::Mat image(page.height, page.width, CV_8U, page.gray.data());
    const auto theirs = charuco::board(
        board.columns, board.rows, static_cast<float>(board.square_m),
        static_cast<float>(board.marker_m),
        board.dictionary == "5x5_100" ? cv::aruco::DICT_5X5_100 : cv::aruco::DICT_4X4_50);
    const std::vector<cv::Point3f> inner_corners = charuco::inner_corners_of(theirs);
    std::vector<std::vector<cv::Point2f>> markers;
    std::vector<int> ids;
    cv::aruco::detectMarkers(image, charuco::dictionary_of(theirs), markers, ids);
    EXPECT_EQ(ids.size(), charuco::ids_of(theirs).size()) << word;
    cv::Mat corners;
    cv::Mat corner_ids;
    cv::aruco::interpolateCornersCharuco(markers, ids, image, theirs, corners, corner_ids);
    ASSERT_EQ(corners.rows, (board.columns - 1) * (board.rows - 1)) << word;
    for (int i = 0; i < corners.rows; ++i) {
      const cv::Point2f off = corners.at<cv::Point2f>(i) - corners.at<cv::Point2f>(0);
      const cv::Point3f wanted =
          inner_corners[static_cast<std::size_t>(corner_ids.at<int>(i))] - inner_corners[0];
      EXPECT_NEAR(kPixel * static_cast<double>(off.x), 1000 * static_cast<double>(wanted.x), 0.1);
      EXPECT_NEAR(kPixel * static_cast<double>(off.y), 1000 * static_cast<double>(wanted.y), 0.1);
    }
  }
}

}  // namespace
}  // namespace swarmsmith
