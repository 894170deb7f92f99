#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "cli/output/query_output.h"
#include "coordinator/service/live_status.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// SQL of a table: v_designs with the mean of the winner's tests and the mean of its other scores,
/// if those have one source. For all designs, or only for `only`: SQLite does not push a condition
/// into a subquery with GROUP BY.
std::string designs_with_means(std::optional<DesignId> only = {});

/// The campaigns of a store as a coordinator would describe them. `is_written`: a process is
/// writing the store; otherwise an unfinished campaign is "interrupted". Errors: as for a query.
Expected<std::vector<CampaignStatus>> stored_campaigns(StoreReader& store, bool is_written);

/// The states in a store come from its last writer. If no process writes it now, no design is
/// running: `racing` and `testing` in the column `state` become `interrupted`. Does nothing to rows
/// without that column.
void mark_interrupted(Rows& designs, bool is_written);

}  // namespace swarmsmith::cli
