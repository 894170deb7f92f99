#pragma once

#include <filesystem>
#include <vector>

#include "base/text/table_reader.h"
#include "coordinator/campaign/campaign.h"

namespace swarmsmith {

/// The [[method]] tables of a campaign file in `folder`, complete: modules that were not named are
/// filled in, in the order of the flavour's tables; files are read. What is wrong goes to the
/// readers' complaints. Parameter files are taken only with a target.
std::vector<Method> read_methods(TableReader& root, const std::filesystem::path& folder,
                                 bool has_target);

/// The [race] table, into the campaign, whose target was read before.
void read_race(TableReader& root, const std::filesystem::path& folder, Campaign& campaign);

}  // namespace swarmsmith
