#pragma once

#include <vector>

#include "base/expected.h"
#include "coordinator/campaign/campaign.h"
#include "coordinator/design/design_runner.h"

namespace swarmsmith {

/// The designs of a campaign, ready to run, in the order of their ids. Fails when a method's space
/// cannot be built.
Expected<std::vector<DesignPlan>> plans_of(const Campaign& campaign);

}  // namespace swarmsmith
