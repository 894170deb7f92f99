#pragma once

#include <optional>

#include "sim/mission/arena.h"
#include "tracking/rig/rig.h"

namespace swarmsmith {

/// The share of the arena's floor, as far as the camera has it in its picture, that lies beyond the
/// corners of the board by which its lens was calibrated, and a margin: there the lens is a guess.
/// Nothing for a calibration of the time before it kept where its corners were.
std::optional<double> share_beyond_reach(const CameraCalibration& lens, const CameraPlace& place,
                                         const Arena& arena);

/// More than this is refused.
inline constexpr double kMostBeyondReach = 0.05;

}  // namespace swarmsmith
