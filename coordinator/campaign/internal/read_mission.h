#pragma once

#include <vector>

#include "coordinator/campaign/campaign.h"
#include "coordinator/campaign/internal/table_reader.h"

namespace swarmsmith {

/// The [[mission]] tables of a campaign file. What is wrong goes to the readers' complaints.
std::vector<CampaignMission> read_missions(TableReader& root);

/// A name that is good for stores, command lines and files: letters, digits, `_`, `-`, `.`.
/// Complains under `key` and says so when it is none, or when it is in `taken`.
bool check_name(TableReader& reader, const std::string& name,
                const std::vector<std::string>& taken);

}  // namespace swarmsmith
