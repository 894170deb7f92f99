#pragma once

#include <string>
#include <vector>

#include "coordinator/campaign/campaign.h"

namespace swarmsmith::cli {

/// Sentences on what runs, but hardly as wanted: modules that cannot do what they are there for
/// with this mission and profile.
std::vector<std::string> warnings_about(const Campaign& campaign);

}  // namespace swarmsmith::cli
