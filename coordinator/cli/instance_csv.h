#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

#include "base/expected.h"
#include "sim/mission/mission.h"

namespace swarmsmith::cli {

/// Starting poses and coloured patches that were recorded elsewhere, by seed.

/// Columns seed, robot (from 0), x, y (metres), theta (radians), in any order; poses by robot.
Expected<std::map<std::int64_t, std::vector<Pose>>> read_starts(const std::filesystem::path& file);

/// Columns seed, x, y (a patch's centre), color (its name). Patches take the size of the mission's
/// place with that centre, which must exist.
Expected<std::map<std::int64_t, std::vector<Patch>>> read_patches(const std::filesystem::path& file,
                                                                  const Mission& mission);

}  // namespace swarmsmith::cli
