#pragma once

#include <optional>
#include <vector>

#include "base/expected.h"
#include "sim/mission/mission.h"

namespace swarmsmith {

/// The patches of one run, each on one of the mission's places and of the place's size: what an
/// instance of the simulator holds. Empty for a mission whose floor is fixed. E_LAYOUT_MISSING when
/// they were shuffled and none are said; E_CONFIG for a patch that lies elsewhere (with the nearest
/// place), for two on one place, for a colour that the mission does not have, and for other numbers
/// of each colour than it has.
Expected<std::vector<Patch>> run_patches(const Mission& mission,
                                         const std::optional<std::vector<Patch>>& patches);

/// The middle of a patch.
Point centre_of(const Patch& patch);

}  // namespace swarmsmith
