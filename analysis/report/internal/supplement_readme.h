#pragma once

#include <string>
#include <vector>

#include "analysis/records/records.h"
#include "analysis/report/supplement.h"

namespace swarmsmith {

/// Describes each file of the supplement, how it was made, how to check it and how to make it
/// again.
std::string supplement_readme(const std::vector<SupplementFile>& files,
                              const std::vector<CampaignRecord>& campaigns, StoreReader& store,
                              const SupplementOptions& options);

}  // namespace swarmsmith
