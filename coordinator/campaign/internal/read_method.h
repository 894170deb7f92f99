#pragma once

#include <filesystem>
#include <vector>

#include "base/text/table_reader.h"
#include "coordinator/campaign/campaign.h"

namespace swarmsmith {

/// Reads the [[method]] tables of a campaign file in `folder`. The result is complete: if no
/// modules are named, all of them are listed, in the order of the flavour's tables, and files are
/// read. Errors go to the readers' complaints. Parameter files are accepted only with a target.
std::vector<Method> read_methods(TableReader& root, const std::filesystem::path& folder,
                                 bool has_target);

/// Reads the [race] table into the campaign; the campaign's target must have been read before.
void read_race(TableReader& root, const std::filesystem::path& folder, Campaign& campaign);

}  // namespace swarmsmith
