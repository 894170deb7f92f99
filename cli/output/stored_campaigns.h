#pragma once

#include <vector>

#include "base/expected.h"
#include "cli/output/query_output.h"
#include "coordinator/service/live_status.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// The campaigns of a store as a coordinator would describe them. `is_written`: a process writes
/// the store; without one, a campaign that is not finished is "interrupted". Errors: as a query's.
Expected<std::vector<CampaignStatus>> stored_campaigns(StoreReader& store, bool is_written);

/// Puts these campaigns' words for their designs into the column `state` of rows with a column
/// `design`; rows without both stay.
void tell_states(Rows& designs, const std::vector<CampaignStatus>& campaigns);

}  // namespace swarmsmith::cli
