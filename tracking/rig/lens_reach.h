#pragma once

#include <optional>

#include "sim/mission/arena.h"
#include "tracking/rig/rig.h"

namespace swarmsmith {

/// The lens calibration is reliable only within the hull of the board's corners, plus a margin.
/// Returns the share of the visible arena floor that lies outside. Nothing for an old calibration,
/// which did not keep the hull.
std::optional<double> share_beyond_reach(const CameraCalibration& lens, const CameraPlace& place,
                                         const Arena& arena);

/// A larger share is refused.
inline constexpr double kMostBeyondReach = 0.05;

}  // namespace swarmsmith
