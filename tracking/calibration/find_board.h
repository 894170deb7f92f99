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
  /// Sharpness of its edges; only comparable between pictures with a similar view of the board.
  double sharpness = 0;
};

/// Finds the board's inner corners to about a hundredth of a pixel: on a ChArUco board each corner
/// with a visible marker next to it, on a chessboard all corners or none. Nothing if fewer than
/// eight corners are visible, or if all of them are on one line.
std::optional<BoardSight> find_board(const GrayImage& image, const Board& board);

/// Chooses at most `most` sights of a video for the calibration, and keeps their order: sights with
/// different places, sizes and angles of the board, and of similar sights the sharpest.
std::vector<std::size_t> pick_views(const std::vector<BoardSight>& sights, const Board& board,
                                    ImageSize size, std::size_t most);

}  // namespace swarmsmith
