#pragma once

#include <cstdint>

#include "base/text/table_reader.h"

namespace swarmsmith {

/// Limits of tags' numbers; a family may have less.
inline constexpr Limits<std::int64_t> kTagNumber{0, 65'535};
/// Limits of lengths in arena files and in calibrations, in metres.
inline constexpr Limits<double> kTagEdge{0.005, 2};
inline constexpr Limits<double> kTagHeight{0, 20};
inline constexpr Limits<double> kCameraHeight{0.05, 100};

}  // namespace swarmsmith
