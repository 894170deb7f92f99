#include "tracking/calibration/board_watch.h"

#include "synthetic.h"
#include "tests/support/checks.h"
#include "tests/support/film/boards.h"
#include "tests/support/film/virtual_camera.h"

namespace swarmsmith {
namespace {

CameraModel half_camera() {
  return {{960, 540}, Lens::Pinhole, 507.5, 507.5, 479.5, 269.5, {-0.285, 0.08, 0, 0, 0}};
}

CameraModel whole_camera() {
  return {{1920, 1080}, Lens::Pinhole, 1015, 1015, 959.5, 539.5, {-0.285, 0.08, 0, 0, 0}};
}

/// The board as it would be printed, a pixel each half millimetre, with a margin.
film::FilmedBoard printed(const Board& board) {
  constexpr double kPixel_m = 0.0005;
  const auto pixels = [&](double metres) {
    return static_cast<int>(std::lround(metres / kPixel_m));
  };
  film::FilmedBoard paper;
  paper.pixel_m = kPixel_m;
  paper.margin_px = 40;
  paper.width = pixels(board.width_m()) + 80;
  paper.height = pixels(board.height_m()) + 80;
  paper.gray.assign(static_cast<std::size_t>(paper.width) * static_cast<std::size_t>(paper.height),
                    255);
  for (const BlackBox& box : black_boxes_of(board)) {
    for (int row = pixels(box.top_m); row < pixels(box.top_m + box.height_m); ++row) {
      const auto first = static_cast<std::ptrdiff_t>(row + 40) * paper.width + 40;
      std::fill(paper.gray.begin() + first + pixels(box.left_m),
                paper.gray.begin() + first + pixels(box.left_m + box.width_m), std::uint8_t{0});
    }
  }
  return paper;
}

struct Shot {
  film::FilmedBoard board;
  std::vector<std::uint8_t> gray;
};

/// The board held before the camera at a place of its picture.
Shot shot_of(const Board& board, ImagePoint middle, double distance_m, double tilt_rad,
             double blur_px = 0.6, const CameraModel& camera = half_camera()) {
  const film::BoardKind size{
      .columns = static_cast<int>(std::lround(board.width_m() / board.square_m)),
      .rows = static_cast<int>(std::lround(board.height_m() / board.square_m)),
      .square_m = board.square_m};
  Shot shot{
      film::held(printed(board), size, camera, middle, distance_m, tilt_rad, -tilt_rad / 2, 0.1),
      {}};
  film::Shooting shooting;
  shooting.view.camera = camera;
  shooting.view.place = film::looking_at({0, 0, 2.7}, {0, 0});
  shooting.blur_px = blur_px;
  film::Scene scene;
  scene.boards.push_back(shot.board);
  shot.gray = film::gray_of(film::VirtualCamera(scene, shooting, 1).picture(0, 0));
  return shot;
}

std::optional<BoardSight> found_in(const Shot& shot, const Board& board) {
  return find_board(film::as_gray_image(shot.gray, half_camera().size), board);
}

TEST(FindBoardTest, CornersOfMarkerBoardsAreWhereTheyAre) {
  for (const char* word : {"charuco:11x8:0.03:0.022:5x5_100", "charuco:7x5:0.045:0.034:4x4_50",
                           "charuco:9x6:0.04:0.03:apriltag_36h11"}) {
    const Board board = *parse_board(word);
    const Shot shot = shot_of(board, {500, 250}, 0.4, 0.5);
    const auto sight = found_in(shot, board);
    ASSERT_TRUE(sight) << word;
    EXPECT_EQ(sight->view.seen.size(), corners_of(board).size()) << word;
    double squares = 0;
    for (std::size_t i = 0; i < sight->view.seen.size(); ++i) {
      const ImagePoint truth =
          film::image_of_board(shot.board, half_camera(), sight->view.board[i]);
      EXPECT_NEAR(sight->view.seen[i].u, truth.u, 0.3) << word << " " << i;
      EXPECT_NEAR(sight->view.seen[i].v, truth.v, 0.3) << word << " " << i;
      squares += std::pow(sight->view.seen[i].u - truth.u, 2) +
                 std::pow(sight->view.seen[i].v - truth.v, 2);
    }
    const double rms = std::sqrt(squares / static_cast<double>(sight->view.seen.size()));
    EXPECT_LT(rms, 0.1) << word;
    RecordProperty(word, std::to_string(rms));
  }
}

TEST(FindBoardTest, APartOfAMarkerBoardIsEnough) {
  const Board board = *parse_board("charuco:11x8:0.03:0.022:5x5_100");
  const Shot shot = shot_of(board, {60, 60}, 0.35, 0.2);
  const auto sight = value_of(found_in(shot, board));
  EXPECT_LT(sight.view.seen.size(), 60U);
  for (std::size_t i = 0; i < sight.view.seen.size(); ++i) {
    const ImagePoint truth = film::image_of_board(shot.board, half_camera(), sight.view.board[i]);
    EXPECT_NEAR(sight.view.seen[i].u, truth.u, 0.4);
    EXPECT_NEAR(sight.view.seen[i].v, truth.v, 0.4);
  }
}

TEST(FindBoardTest, AChessboardIsFoundWholeWithoutAShiftOfHalfAPixel) {
  const Board board = *parse_board("chessboard:10x7:0.03");
  const Shot shot = shot_of(board, {480, 270}, 0.45, 0.4);
  const auto sight = value_of(found_in(shot, board));
  ASSERT_EQ(sight.view.seen.size(), 70U);
  // Which end is the first cannot be told; the corners as a set can.
  ImagePoint mean;
  for (const ImagePoint& seen : sight.view.seen) {
    double nearest = 1e9;
    ImagePoint off;
    for (const Point& corner : corners_of(board)) {
      const ImagePoint truth = film::image_of_board(shot.board, half_camera(), corner);
      const double away = std::hypot(seen.u - truth.u, seen.v - truth.v);
      if (away >= nearest) continue;
      nearest = away;
      off = {seen.u - truth.u, seen.v - truth.v};
    }
    EXPECT_LT(nearest, 0.2);
    mean.u += off.u / 70;
    mean.v += off.v / 70;
  }
  EXPECT_NEAR(mean.u, 0, 0.05);
  EXPECT_NEAR(mean.v, 0, 0.05);
  EXPECT_FALSE(found_in(shot_of(board, {40, 270}, 0.45, 0.4), board));
}

/// It is searched for in half the picture, which is coarse; what counts is refined in the whole.
TEST(FindBoardTest, CornersOfALargePictureAreThoseOfTheWholePicture) {
  const Board board = *parse_board("chessboard:10x7:0.03");
  const CameraModel camera = whole_camera();
  for (const double distance : {0.45, 0.9}) {
    const Shot shot = shot_of(board, {900, 600}, distance, 0.4, 0.6, camera);
    const auto sight = find_board(film::as_gray_image(shot.gray, camera.size), board);
    ASSERT_TRUE(sight) << distance;
    ASSERT_EQ(sight->view.seen.size(), 70U);
    double squares = 0;
    for (const ImagePoint& seen : sight->view.seen) {
      double nearest = 1e9;
      for (const Point& corner : corners_of(board)) {
        const ImagePoint truth = film::image_of_board(shot.board, camera, corner);
        nearest = std::min(nearest, std::hypot(seen.u - truth.u, seen.v - truth.v));
      }
      squares += nearest * nearest;
    }
    EXPECT_LT(std::sqrt(squares / 70), 0.06) << distance;
  }
}

/// From near and far, tilted, to the edges of the picture: where the lens bends most.
TEST(FindBoardTest, CornersOfChessboardsAreRefinedWhereverTheyAre) {
  const Board board = *parse_board("chessboard:10x7:0.03");
  double squares = 0;
  int count = 0;
  for (const double distance : {0.45, 0.8}) {
    for (const ImagePoint middle : {ImagePoint{480, 270}, {700, 350}}) {
      for (const double tilt : {0.1, 0.6}) {
        const Shot shot = shot_of(board, middle, distance, tilt);
        const auto sight = found_in(shot, board);
        if (!sight) continue;
        double of_view = 0;
        for (const ImagePoint& seen : sight->view.seen) {
          double nearest = 1e9;
          for (const Point& corner : corners_of(board)) {
            const ImagePoint truth = film::image_of_board(shot.board, half_camera(), corner);
            nearest = std::min(nearest, std::hypot(seen.u - truth.u, seen.v - truth.v));
          }
          of_view += nearest * nearest;
        }
        const double corners = static_cast<double>(sight->view.seen.size());
        EXPECT_LT(std::sqrt(of_view / corners), 0.12)
            << distance << " m, tilt " << tilt << ", middle " << middle.u << ", " << middle.v;
        squares += of_view;
        count += static_cast<int>(corners);
      }
    }
  }
  EXPECT_GE(count, 6 * 70);
  EXPECT_LT(std::sqrt(squares / count), 0.07);
}

TEST(FindBoardTest, AnotherBoardIsNone) {
  const Shot shot = shot_of(*parse_board("charuco:11x8:0.03:0.022:5x5_100"), {500, 250}, 0.4, 0);
  EXPECT_FALSE(found_in(shot, *parse_board("charuco:11x8:0.03:0.022:4x4_100")));
  const std::vector<std::uint8_t> gray(16 * 16, 128);
  EXPECT_FALSE(
      find_board(film::as_gray_image(gray, {16, 16}), *parse_board("chessboard:5x4:0.03")));
}

TEST(PickViewsTest, TakesViewsThatDifferAndOfThoseAlikeTheSharpest) {
  const CameraModel camera = wide_camera();
  const Board board = *parse_board("charuco:11x8:0.03:0.022:5x5_100");
  std::vector<BoardSight> sights;
  for (int i = 0; i < 12; ++i) {
    const BoardView view = held_boards(camera, 12, 3)[static_cast<std::size_t>(i)];
    for (const double sharpness : {0.4, 0.9, 0.5})
      sights.push_back({view, sharpness});
  }
  const auto all = pick_views(sights, board, camera.size, 40);
  ASSERT_EQ(all.size(), 12U);
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_EQ(all[i], 3 * i + 1);
  const auto few = pick_views(sights, board, camera.size, 5);
  EXPECT_EQ(few.size(), 5U);
  EXPECT_TRUE(std::ranges::is_sorted(few));
}

TEST(BoardWatchTest, CountsViewsThatDifferAndLooksTwiceASecond) {
  const Board board = *parse_board("charuco:7x5:0.045:0.034:4x4_50");
  const Shot left = shot_of(board, {250, 250}, 0.6, 0.3);
  const Shot right = shot_of(board, {700, 300}, 0.6, -0.3);
  const std::vector<std::uint8_t> nothing(left.gray.size(), 128);
  BoardWatch watch(board);
  const auto look = [&](const std::vector<std::uint8_t>& gray, double time_s) {
    return watch.look_at(film::as_gray_image(gray, half_camera().size), time_s);
  };
  const BoardProgress first = look(left.gray, 7);
  EXPECT_TRUE(first.is_seen);
  EXPECT_EQ(first.views, 1);
  EXPECT_GT(first.coverage, 0.02);
  EXPECT_TRUE(look(nothing, 7.4).is_seen) << "too soon to look again";
  EXPECT_FALSE(look(nothing, 7.6).is_seen);
  EXPECT_EQ(look(left.gray, 8.2).views, 1);
  const BoardProgress both = look(right.gray, 8.8);
  EXPECT_EQ(both.views, 2);
  EXPECT_GT(both.coverage, first.coverage);
  EXPECT_GT(std::ranges::count_if(both.ninths, [](int n) { return n > 0; }), 2);
}

}  // namespace
}  // namespace swarmsmith
