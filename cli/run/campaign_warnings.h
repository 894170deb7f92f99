#pragma once

#include <string>
#include <vector>

#include "coordinator/campaign/campaign.h"

namespace swarmsmith::cli {

/// Warnings about campaigns that can run but probably not as intended, such as modules that cannot
/// work with this mission and profile.
std::vector<std::string> warnings_about(const Campaign& campaign);

}  // namespace swarmsmith::cli
