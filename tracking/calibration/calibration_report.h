#pragma once

#include <span>
#include <string>

#include "tracking/calibration/solve_camera.h"

namespace swarmsmith {

/// Calibrations as people read them, a few lines each, without a date.
///
/// Of a camera: each view's RMS, which were dropped, how many corners lie in each ninth of the
/// frame, and which ninths are empty.
std::string report_text(const CameraSolution& solution, std::span<const BoardView> views);
std::string report_text(const PlaceCalibration& calibration);
std::string report_text(const OffsetCalibration& calibration);

/// The residuals of all used corners over the frame, as an SVG drawing: a line from each corner to
/// where the lens model expects it, lengthened so that half a pixel shows.
std::string residual_map_svg(const CameraSolution& solution, std::span<const BoardView> views);

}  // namespace swarmsmith
