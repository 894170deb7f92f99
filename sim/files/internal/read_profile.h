#pragma once

#include "base/text/table_reader.h"
#include "sim/engine/profile.h"

namespace swarmsmith {

/// Control periods are written to the microsecond, so that texts read back to the same bits.
inline constexpr double kMicroseconds_per_period = 100'000;

/// Reads the fields of a profile from its table and subtables. A field that is missing in the file
/// keeps its value.
void read_profile_fields(TableReader& table, Profile& profile);

}  // namespace swarmsmith
