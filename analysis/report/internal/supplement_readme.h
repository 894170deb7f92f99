#pragma once

#include <string>
#include <vector>

#include "analysis/records/records.h"
#include "analysis/report/supplement.h"

namespace swarmsmith {

/// What each file of the supplement is, how it was made, how to check it and to make it again.
/// `digest` is that of the store's answer.
std::string supplement_readme(const std::vector<SupplementFile>& files,
                              const std::vector<CampaignRecord>& campaigns,
                              const std::string& digest, const SupplementOptions& options);

}  // namespace swarmsmith
