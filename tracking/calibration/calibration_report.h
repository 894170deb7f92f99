#pragma once

#include <span>
#include <string>

#include "tracking/calibration/solve_camera.h"

namespace swarmsmith {

/// Calibrations as text for people, a few lines each, without a date.
///
/// For a camera: the RMS of each view, the dropped views, the number of corners in each ninth of
/// the frame, and the empty ninths.
std::string report_text(const CameraSolution& solution, std::span<const BoardView> views);
std::string report_text(const PlaceCalibration& calibration);
std::string report_text(const OffsetCalibration& calibration);

/// The residuals of all used corners over the frame, as an SVG drawing: a line from each corner to
/// its position in the lens model, magnified so that half a pixel is visible.
std::string residual_map_svg(const CameraSolution& solution, std::span<const BoardView> views);

}  // namespace swarmsmith
