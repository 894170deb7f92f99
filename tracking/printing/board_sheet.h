#pragma once

#include <string>

#include "base/expected.h"
#include "tracking/calibration/board.h"
#include "tracking/printing/paper.h"

namespace swarmsmith {

/// A page as SVG with the calibration board in true scale, in portrait or landscape. BadInput for a
/// board that is too large; the error gives the largest similar board that fits.
Expected<std::string> board_sheet(const Board& board, const Paper& paper);

}  // namespace swarmsmith
