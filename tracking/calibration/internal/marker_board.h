#pragma once

#include <opencv2/aruco/charuco.hpp>

#include "tracking/calibration/board.h"

namespace swarmsmith {

/// OpenCV's number of a dictionary's name; nothing for an unknown one.
std::optional<int> dictionary_number(std::string_view name);
/// The board, which must be a ChArUco one, as OpenCV has it.
cv::Ptr<cv::aruco::CharucoBoard> marker_board(const Board& board);

}  // namespace swarmsmith
