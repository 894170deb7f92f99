#pragma once

#include <optional>
#include <span>

#include "sim/mission/arena.h"
#include "tracking/rig/rig.h"

namespace swarmsmith {

/// The lens calibration is reliable only within the hull of the board's corners, plus a margin.
/// Returns the share of the visible arena floor that lies outside. Nothing for an old calibration,
/// which did not keep the hull.
std::optional<double> share_beyond_reach(const CameraCalibration& lens, const CameraPlace& place,
                                         const Arena& arena);

/// The share of the visible part of an arena, given by its corners, that lies within the hull of
/// the floor tags, 0 to 1; counted on a grid of 2 cm, or a wider one in arenas over 10 m.
double share_within_tags(std::span<const ReferenceTag> tags, const View& view,
                         std::span<const Point> arena);

/// A larger share is refused.
inline constexpr double kMostBeyondReach = 0.05;

}  // namespace swarmsmith
