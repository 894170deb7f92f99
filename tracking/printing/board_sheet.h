#pragma once

#include <string>

#include "base/expected.h"
#include "tracking/calibration/board.h"
#include "tracking/printing/paper.h"

namespace swarmsmith {

/// A page as SVG with the calibration board in true scale, on the paper standing or lying.
/// BadInput for a board that is too large, with the largest of its kind that fits.
Expected<std::string> board_sheet(const Board& board, const Paper& paper);

}  // namespace swarmsmith
