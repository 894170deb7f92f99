#pragma once

#include <vector>

#include "base/expected.h"
#include "coordinator/campaign/campaign.h"

namespace swarmsmith {

/// What keeps the campaign's programs from being run: missing, not executable, a folder that is not
/// there, a template without what it needs. Asked before anything runs; a store can be read and
/// verified without its programs. None for a campaign of the simulator.
std::vector<Error> check_programs(const Campaign& campaign);

}  // namespace swarmsmith
