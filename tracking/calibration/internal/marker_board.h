#pragma once

#include <optional>
#include <string_view>

#include "tracking/calibration/board.h"
#include "tracking/calibration/internal/charuco.h"

namespace swarmsmith {

/// OpenCV's number for the name of a dictionary; nothing for an unknown name.
std::optional<int> dictionary_number(std::string_view name);
/// OpenCV's object for a board, which must be a ChArUco board.
charuco::Board marker_board(const Board& board);

}  // namespace swarmsmith
