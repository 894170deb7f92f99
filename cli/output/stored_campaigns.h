#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "cli/output/query_output.h"
#include "coordinator/service/live_status.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// v_designs with the mean of the winner's tests, and of its other scores where these have one
/// source: to be asked as a table. Of all designs, or of `only`: SQLite does not carry a condition
/// into what groups.
std::string designs_with_means(std::optional<DesignId> only = {});

/// The campaigns of a store as a coordinator would describe them. `is_written`: a process writes
/// the store; without one, a campaign that is not finished is "interrupted". Errors: as a query's.
Expected<std::vector<CampaignStatus>> stored_campaigns(StoreReader& store, bool is_written);

/// A store says what its last writer said. Where no process writes it any more, no design is at
/// work: `racing` and `testing` in the column `state` become `interrupted`. Rows without that
/// column stay.
void mark_interrupted(Rows& designs, bool is_written);

}  // namespace swarmsmith::cli
