#pragma once

#include <vector>

#include "base/expected.h"
#include "coordinator/campaign/campaign.h"

namespace swarmsmith {

/// The problems that prevent the campaign's programs from being run: missing or non-executable
/// programs, missing folders, a command-line template without its necessary parts. Checked before
/// anything runs; a store can be read and verified without its programs. Empty for a campaign that
/// uses the simulator.
std::vector<Error> check_programs(const Campaign& campaign);

}  // namespace swarmsmith
