#pragma once

#include <string_view>

#include "base/text/table_reader.h"
#include "sim/mission/pose.h"

namespace swarmsmith {

/// Places and sizes in metres that arenas may have.
inline constexpr Limits<double> kCoordinate{-100, 100};
inline constexpr Limits<double> kSize{0.001, 200};

/// A number that must be there; the upper limit after a complaint.
double need(TableReader& table, std::string_view key, Limits<double> limits);

/// `x` and `y`, which must be there.
Point need_point(TableReader& table);

/// `angle` in degrees, or `theta` in radians, counter-clockwise from the x axis; 0 when neither is
/// there. In (-pi, pi].
double read_heading(TableReader& table);

}  // namespace swarmsmith
