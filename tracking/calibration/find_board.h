#pragma once

#include <optional>
#include <vector>

#include "tracking/calibration/board.h"
#include "tracking/calibration/solve_camera.h"
#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// A board in a picture, without the picture's name.
struct BoardSight {
  BoardView view;
  /// How sharp its edges are; only compares pictures that show the board alike.
  double sharpness = 0;
};

/// The board's inner corners to a hundredth or so of a pixel: a ChArUco board wherever a marker on
/// either side is seen, a chessboard only as a whole. Nothing when fewer than eight corners are
/// seen, or all in one line.
std::optional<BoardSight> find_board(const GrayImage& image, const Board& board);

/// Which of a video's sights to solve from, at most `most`, in their order: those that show the
/// board at places, sizes and angles that differ, and of those alike the sharpest.
std::vector<std::size_t> pick_views(const std::vector<BoardSight>& sights, const Board& board,
                                    ImageSize size, std::size_t most);

}  // namespace swarmsmith
