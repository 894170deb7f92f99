#pragma once

#include <span>
#include <string_view>

#include "base/text/table_reader.h"
#include "sim/mission/pose.h"

namespace swarmsmith {

/// Limits of coordinates and sizes in arenas, in metres.
inline constexpr Limits<double> kCoordinate{-100, 100};
inline constexpr Limits<double> kSize{0.001, 200};

/// Whether all coordinates are within kCoordinate; only such corners can be read from a text.
bool can_be_read(std::span<const Point> corners);

/// Reads a required number; gives the upper limit after a complaint.
double need(TableReader& table, std::string_view key, Limits<double> limits);

/// Reads `x` and `y`, which are required.
Point need_point(TableReader& table);

/// Reads `angle` in degrees, or `theta` in radians, counter-clockwise from the x axis; 0 if both
/// are missing. The result is in (-pi, pi].
double read_heading(TableReader& table);

}  // namespace swarmsmith
