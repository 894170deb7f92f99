#pragma once

#include <optional>
#include <vector>

#include "base/expected.h"
#include "sim/mission/mission.h"

namespace swarmsmith {

/// The patches of one run, as in an instance of the simulator: each is on one of the mission's
/// places and has the size of the place. Empty for a mission with a fixed floor. E_LAYOUT_MISSING
/// if the patches are shuffled and none are given. E_CONFIG for a patch that is not on a place
/// (with the nearest place), for two patches on one place, for a colour that the mission does not
/// have, and for a wrong number of patches of a colour.
Expected<std::vector<Patch>> run_patches(const Mission& mission,
                                         const std::optional<std::vector<Patch>>& patches);

/// The centre of a patch.
Point centre_of(const Patch& patch);

}  // namespace swarmsmith
