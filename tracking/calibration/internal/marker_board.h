#pragma once

#include <optional>
#include <string_view>

#include "tracking/calibration/board.h"
#include "tracking/calibration/internal/charuco.h"

namespace swarmsmith {

/// OpenCV's number of a dictionary's name; nothing for an unknown one.
std::optional<int> dictionary_number(std::string_view name);
/// The board, which must be a ChArUco one, as OpenCV has it.
charuco::Board marker_board(const Board& board);

}  // namespace swarmsmith
